#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "commands/noise_option.hpp"
#include "simulation/perception.hpp"
#include "simulation/road.hpp"

namespace laneloom {

/// The road that a command drives over, and how it is seen: options of `publish` and `simulate`.
struct RoadSource {
  std::string scenario, argoverse2, lanelet2;
  double speed_mps = 10.0;
  NoiseOption noise{.name = "none"};
  std::uint64_t seed = 1;

  /// One source per log where a directory of several is given, else this one alone.
  std::vector<RoadSource> each() const;
  /// Throws std::runtime_error or std::invalid_argument naming what is wrong with the road, or where there
  /// are several.
  Road load() const;
  Perception perception(const Road& road) const;
};

/// One of --scenario, --argoverse2, --lanelet2, and --speed, --noise, --no-field-of-view, --seed.
void add_road_source(CLI::App& command, RoadSource& source);

}  // namespace laneloom
