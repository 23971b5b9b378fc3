#pragma once

#include "laneloom/types.hpp"

namespace laneloom::drive {

inline constexpr double kWheelbase_m = 2.8;
inline constexpr double kMaxSteering_rad = 0.6;
inline constexpr double kMaxSteeringRate_radps = 0.6;
inline constexpr double kMaxAcceleration_mps2 = 1.5;
inline constexpr double kMaxBraking_mps2 = 3.0;

/// A place as a point of height 0. Vehicles are steered on a plane, but lines carry heights along.
inline Point on_ground(const Eigen::Vector2d& p) { return {p.x(), p.y(), 0.0}; }

/// The command of a planner to the vehicle.
struct Command {
  double steering_rad = 0.0;
  double speed_mps = 0.0;
};

/// A kinematic bicycle on a plane, in the map frame.
struct Bicycle {
  Eigen::Vector2d rear_axle = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
  double speed_mps = 0.0;
  double steering_rad = 0.0;

  /// Curvature of its way to the left, 1/m.
  double curvature() const;
  Eigen::Vector2d direction() const;
  /// The place midway between the axles.
  Eigen::Vector2d centre() const { return rear_axle + 0.5 * kWheelbase_m * direction(); }
  /// Follows a command for `dt_s`, as fast as steering and speed can change.
  void step(const Command& command, double dt_s);
};

}  // namespace laneloom::drive
