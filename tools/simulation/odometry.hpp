#pragma once

#include <Eigen/Geometry>

namespace laneloom::simulation {

/// Sums the true motion, with an error in every step. The scale is wrong, and the heading turns away so that
/// half of the drift is sideways after 100 m.
class Odometry {
 public:
  /// `drift` is a share of the distance driven.
  Odometry(const Eigen::Isometry3d& start, double drift) : true_(start), told_(start), drift_(drift) {}

  /// The pose by the odometry, for the true pose T_map_body.
  const Eigen::Isometry3d& move_to(const Eigen::Isometry3d& T_map_body);

 private:
  Eigen::Isometry3d true_, told_;
  double drift_;
};

}  // namespace laneloom::simulation
