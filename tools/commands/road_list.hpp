#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "experiment/drive_simulation.hpp"

namespace laneloom {

/// Drives over several roads: options of `experiment`, `calibrate` and `drive`.
struct RoadList {
  std::vector<std::string> scenarios, argoverse2, lanelet2;
  std::vector<std::uint64_t> seeds{1};
  double speed_mps = 10.0;
  double duration_s = 60.0;
  double drift = 0.0;

  /// One drive per road, noise and seed. Throws what loading a road throws.
  std::vector<DriveSpec> drives(const std::vector<NoiseProfile>& noises) const;
};

/// --scenario, --argoverse2, --lanelet2, --seeds and --drift.
void add_roads(CLI::App& command, RoadList& roads);
/// These, --speed and --duration.
void add_road_list(CLI::App& command, RoadList& roads);

}  // namespace laneloom
