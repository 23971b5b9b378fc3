#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "io/json_lines.hpp"
#include "simulation/noise_profile.hpp"
#include "simulation/road.hpp"

namespace laneloom {

/// A drive over a known road.
struct DriveSpec {
  std::shared_ptr<const Road> road;
  NoiseProfile noise;
  std::uint64_t seed = 1;
  double duration_s = 0.0;  ///< 0: the road's drive once; a drive that is not closed is never longer
  double drift = 0.0;       ///< of the odometry, as a share of the distance driven
};

/// What a network and an odometry say at one instant, and what is true.
struct SimulatedFrame {
  FrameRecord record;              ///< with the odometry's pose
  std::vector<ElementId> sources;  ///< truth marking of every detection; none: a ghost
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();  ///< true
};

/// Ten frames per second, from 0.1 s on. The same spec gives the same frames.
///
/// How an odometry drifts is in simulation/odometry.hpp.
std::vector<SimulatedFrame> simulate(const DriveSpec& spec);

}  // namespace laneloom
