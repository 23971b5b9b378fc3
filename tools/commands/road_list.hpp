#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "experiment/drive_simulation.hpp"

namespace laneloom::commands {

/// Options of `experiment`, `calibrate` and `drive` for drives over several roads.
struct RoadList {
  std::vector<std::string> scenarios, argoverse2, lanelet2;
  std::vector<std::uint64_t> seeds{1};
  double speed_mps = 10.0;
  double duration_s = 60.0;
  double drift = 0.0;
  std::string traffic;  ///< a profile; empty: none

  /// The drives, one per road, noise and seed. Throws as the loading of a road.
  std::vector<experiment::DriveSpec> drives(const std::vector<simulation::NoiseProfile>& noises) const;
};

/// Adds --scenario, --argoverse2, --lanelet2, --seeds and --drift.
void add_roads(CLI::App& command, RoadList& roads);
/// Adds these, --speed and --duration.
void add_road_list(CLI::App& command, RoadList& roads);

}  // namespace laneloom::commands
