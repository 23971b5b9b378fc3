#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::simulation {

/// The motion of the vehicle over a road: timed poses T_map_body, with interpolation between them (linear and
/// slerp).
class Drive {
 public:
  Drive() = default;

  /// A drive at constant speed along a path in the map frame, of at least two different points. The path is
  /// smoothed first, so that the yaw is continuous; a path that ends where it starts is smoothed round. Yaw
  /// follows the path, and pitch its slope. Throws std::invalid_argument if the path has no length or the
  /// speed is not positive.
  static Drive along(const Polyline& path, double speed_mps);

  /// A drive of recorded poses in ascending order of stamps; their first stamp becomes time 0. Throws
  /// std::invalid_argument if the stamps do not ascend.
  static Drive recorded(std::vector<VehiclePose> poses);

  /// The duration; of a closed drive, that of one lap. 0 for an empty drive.
  double duration_s() const;

  /// Whether the drive ends as it starts, so that it can be repeated without a jump of the pose.
  bool closed() const;

  /// The pose at a time since the start; its stamp is that time. Beyond its end a closed drive begins anew,
  /// and any other stands still. The drive must not be empty.
  VehiclePose pose_at(double t_s) const;

  /// Stamps are times since the start.
  const std::vector<VehiclePose>& poses() const { return poses_; }

 private:
  std::vector<VehiclePose> poses_;
};

}  // namespace laneloom::simulation
