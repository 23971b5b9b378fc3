#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "io/json_lines.hpp"
#include "simulation/noise_profile.hpp"
#include "simulation/odometry.hpp"
#include "simulation/road.hpp"
#include "simulation/sensor_view.hpp"

namespace laneloom {

class Perception;

/// A drive over a known road.
struct DriveSpec {
  std::shared_ptr<const Road> road;
  NoiseProfile noise;
  std::uint64_t seed = 1;
  double duration_s = 0.0;  ///< 0: the road's drive once; a drive that is not closed is never longer
  double drift = 0.0;       ///< of the odometry, as a share of the distance driven
  SensorView view;
};

/// What a network and an odometry say at one instant, and what is true.
struct SimulatedFrame {
  FrameRecord record;              ///< with the odometry's pose
  std::vector<ElementId> sources;  ///< truth marking of every detection; none: a ghost
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();  ///< true
};

/// Ten frames per second, from 0.1 s on and for ever; after the end of a drive that is not closed, the
/// vehicle stands. The same spec gives the same frames. How an odometry drifts is in simulation/odometry.hpp.
/// Not thread-safe.
class DriveSimulation {
 public:
  explicit DriveSimulation(const DriveSpec& spec);
  ~DriveSimulation();
  DriveSimulation(DriveSimulation&&) noexcept;
  DriveSimulation& operator=(DriveSimulation&&) noexcept;

  SimulatedFrame next();

 private:
  DriveSpec spec_;
  std::unique_ptr<Perception> perception_;
  Odometry odometry_;
  std::int64_t stamp_ns_ = 0;
};

/// The frames of the spec's duration.
std::vector<SimulatedFrame> simulate(const DriveSpec& spec);

}  // namespace laneloom
