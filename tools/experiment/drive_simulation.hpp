#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "io/json_lines.hpp"
#include "simulation/noise_profile.hpp"
#include "simulation/odometry.hpp"
#include "simulation/road.hpp"
#include "simulation/sensor_view.hpp"
#include "simulation/traffic.hpp"

namespace laneloom::simulation {
class Perception;
}

namespace laneloom::experiment {

/// A drive over a known road.
struct DriveSpec {
  std::shared_ptr<const simulation::Road> road;
  simulation::NoiseProfile noise;
  std::uint64_t seed = 1;
  double duration_s = 0.0;  ///< 0: once along the road's drive; a drive that is not closed is never longer
  double drift = 0.0;       ///< of the odometry, as a share of the distance driven
  simulation::SensorView view;
  std::optional<simulation::TrafficProfile> traffic;  ///< none: there is no tracker
};

/// The output of a network and an odometry at one instant, with the truth.
struct SimulatedFrame {
  io::FrameRecord record;          ///< with the odometry's pose
  std::vector<ElementId> sources;  ///< true marking of every detection; kNoElement: it is a ghost
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();  ///< the true pose
};

/// Simulates a drive with ten frames per second, from 0.1 s on, without end. At the end of a drive that is
/// not closed, the vehicle stands. The same spec gives the same frames. simulation/odometry.hpp describes how
/// the odometry drifts. Not thread-safe.
class DriveSimulation {
 public:
  explicit DriveSimulation(const DriveSpec& spec);
  ~DriveSimulation();
  DriveSimulation(DriveSimulation&&) noexcept;
  DriveSimulation& operator=(DriveSimulation&&) noexcept;

  SimulatedFrame next();

 private:
  DriveSpec spec_;
  std::unique_ptr<simulation::Perception> perception_;
  std::optional<simulation::Traffic> traffic_;
  simulation::Odometry odometry_;
  std::int64_t stamp_ns_ = 0;
};

/// The frames of the spec's duration.
std::vector<SimulatedFrame> simulate(const DriveSpec& spec);

}  // namespace laneloom::experiment
