#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// How the vehicle moves over a road: timed poses T_map_body, interpolated between (linear and slerp).
class Drive {
 public:
  Drive() = default;

  /// At constant speed along a path in the map frame (at least two points apart), which is smoothed first so
  /// that the yaw is continuous; yaw follows the path and pitch its slope. A path that ends where it starts
  /// is smoothed round.
  /// Throws std::invalid_argument where the path has no length or the speed is not positive.
  static Drive along(const Polyline& path, double speed_mps);

  /// Of recorded poses in ascending stamp order; their first stamp becomes time 0.
  /// Throws std::invalid_argument where the stamps do not ascend.
  static Drive recorded(std::vector<VehiclePose> poses);

  /// Of one lap where the drive is closed. 0 for an empty drive.
  double duration_s() const;

  /// It ends as it starts, so that it can be driven round and round without a pose jump.
  bool closed() const;

  /// The pose at a time since the start; its stamp is that time. Beyond its end a closed drive begins anew,
  /// any other stays where it is. The drive must not be empty.
  VehiclePose pose_at(double t_s) const;

  /// Stamps are times since the start.
  const std::vector<VehiclePose>& poses() const { return poses_; }

 private:
  std::vector<VehiclePose> poses_;
};

}  // namespace laneloom
