#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "export/line_archive.hpp"
#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// What a whole drive knows, of its local maps: the lines, each place as the map had it when the place was
/// last in it, and the way that the vehicle drove. What left the map because it was not there is left out;
/// what left it because the vehicle drove on stays. Several passes of a place are one (line_archive.hpp).
/// Inferred boundaries are left out: they follow from the lines. So are roadedges where the vehicle drove
/// (driven_over.hpp). Not thread-safe.
class DriveAccumulator {
 public:
  /// `range` is the one of the maps: what is beyond it, with its margin, has left the map.
  explicit DriveAccumulator(const RangeConfig& range) : range_(range) {}

  /// The next map, in the order of stamps, in the frame of those before.
  void add(const LocalMap& map);
  /// The maps that follow know nothing of those before: the service was restarted, or its map cleared.
  void begin_anew();

  struct Drive {
    std::vector<Marking> markings;         ///< lanelines, roadedges and stoplines, with ids from 1 on
    std::vector<Eigen::Isometry3d> poses;  ///< T_map_body, about every 2 m
  };
  /// All that was added. Nothing may be added after it.
  Drive finish();

 private:
  void archive_what_left(const LocalMap& before, const LocalMap& now);
  void archive_all(const LocalMap& map);

  RangeConfig range_;
  LineArchive archive_;
  std::optional<LocalMap> before_;  ///< the last map that was looked at,
  std::optional<LocalMap> newest_;  ///< and a later one that differs little
  std::vector<Eigen::Isometry3d> poses_;
  std::uint64_t pass_ = 0;
};

}  // namespace laneloom
