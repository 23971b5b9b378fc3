#include "drive/bicycle.hpp"

#include <algorithm>
#include <cmath>

namespace laneloom::drive {

double Bicycle::curvature() const { return std::tan(steering_rad) / kWheelbase_m; }

Eigen::Vector2d Bicycle::direction() const { return {std::cos(heading_rad), std::sin(heading_rad)}; }

void Bicycle::step(const Command& command, double dt_s) {
  const double turn_rad = kMaxSteeringRate_radps * dt_s;
  const double wanted_rad = std::clamp(command.steering_rad, -kMaxSteering_rad, kMaxSteering_rad);
  steering_rad += std::clamp(wanted_rad - steering_rad, -turn_rad, turn_rad);
  speed_mps += std::clamp(std::max(0.0, command.speed_mps) - speed_mps, -kMaxBraking_mps2 * dt_s,
                          kMaxAcceleration_mps2 * dt_s);
  const double travel_m = speed_mps * dt_s;
  const double turned_rad = travel_m * curvature();
  heading_rad += 0.5 * turned_rad;
  rear_axle += travel_m * direction();
  heading_rad += 0.5 * turned_rad;
}

}  // namespace laneloom::drive
