#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "export/line_archive.hpp"
#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::exports {

/// Collects the lines of a whole drive from its local maps, and the way that the vehicle drove. Each place is
/// taken from the last map that it was in. Lines that left a map because the vehicle drove on are kept; lines
/// that left it because they turned out not to be there are not. Several passes of a place are made one
/// (line_archive.hpp). Inferred boundaries are left out, since they follow from the lines, and so are
/// roadedges where the vehicle drove (driven_over.hpp). Not thread-safe.
class DriveAccumulator {
 public:
  /// `range` is the range of the maps. A line beyond it and its margin has left the map because the vehicle
  /// drove on.
  explicit DriveAccumulator(const RangeConfig& range) : range_(range) {}

  /// Adds the next map, in the order of stamps. It must be in the frame of those before.
  void add(const LocalMap& map);
  /// Notes that the maps that follow do not continue those before: the service was restarted, or its map
  /// cleared.
  void begin_anew();

  struct Drive {
    std::vector<Marking> markings;         ///< lanelines, roadedges and stoplines, with ids from 1 on
    std::vector<Eigen::Isometry3d> poses;  ///< T_map_body, about every 2 m
  };
  /// The drive of all maps that were added. Nothing may be added after it.
  Drive finish();

 private:
  void archive_what_left(const LocalMap& before, const LocalMap& now);
  void archive_all(const LocalMap& map);

  RangeConfig range_;
  LineArchive archive_;
  std::optional<LocalMap> before_;  ///< the last map that was used
  std::optional<LocalMap> newest_;  ///< a later map, which differs little
  std::vector<Eigen::Isometry3d> poses_;
  std::uint64_t pass_ = 0;
};

}  // namespace laneloom::exports
