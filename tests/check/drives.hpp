#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "check/drive.hpp"
#include "simulation/perception.hpp"
#include "simulation/scenarios.hpp"

namespace laneloom::check {

/// A sound drive over a built-in road, at 10 frames a second, with a pose at each stamp.
inline Drive simulated_drive(const std::string& scenario, const std::string& noise) {
  const simulation::Road road = simulation::make_scenario(scenario);
  simulation::Perception perception(road, simulation::noise_profile(noise), {}, 1);
  Drive drive;
  const double duration_s = std::min(40.0, road.drive.duration_s());
  for (int i = 1; 0.1 * i < duration_s; ++i) {
    VehiclePose pose = road.drive.pose_at(0.1 * i);
    pose.stamp_ns = i * std::int64_t{100'000'000};
    drive.poses.push_back(pose);
    drive.frames[""].push_back(perception.observe(pose));
  }
  return drive;
}

}  // namespace laneloom::check
