#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "export/archived_line.hpp"
#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::exports {

/// The lines of a drive, in the frame of its poses.
struct DriveLines {
  std::vector<ArchivedPiece> pieces;     ///< in the order in which they left the map
  std::vector<Eigen::Isometry3d> poses;  ///< T_map_body, about every 2 m
};

/// Collects the lines of a drive from its local maps, and the way that the vehicle drove. Each place is
/// taken from the last map that it was in. Lines that left a map because the vehicle drove on are kept; lines
/// that left it because they turned out not to be there are not. Inferred boundaries are left out, since they
/// follow from the lines. Not thread-safe.
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

  /// The lines of all maps that were added. Nothing may be added after it.
  DriveLines finish();

 private:
  void keep_what_left(const LocalMap& before, const LocalMap& now);
  void keep_all(const LocalMap& map);

  RangeConfig range_;
  DriveLines drive_;
  std::optional<LocalMap> before_;  ///< the last map that was used
  std::optional<LocalMap> newest_;  ///< a later map, which differs little
  std::uint64_t pass_ = 0;
};

}  // namespace laneloom::exports
