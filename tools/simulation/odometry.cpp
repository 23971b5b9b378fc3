#include "simulation/odometry.hpp"

namespace laneloom::simulation {

const Eigen::Isometry3d& Odometry::move_to(const Eigen::Isometry3d& T_map_body) {
  constexpr double kYawPerMetre = 0.01;  // per drift: after s metres, 0.005 s^2 of it are sideways
  Eigen::Isometry3d step = true_.inverse() * T_map_body;
  const double length_m = step.translation().norm();
  step.translation() *= 1.0 + drift_;
  step.rotate(Eigen::AngleAxisd(kYawPerMetre * drift_ * length_m, Eigen::Vector3d::UnitZ()));
  true_ = T_map_body;
  told_ = told_ * step;
  return told_;
}

}  // namespace laneloom::simulation
