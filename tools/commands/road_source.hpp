#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "commands/noise_option.hpp"
#include "laneloom/objects.hpp"
#include "simulation/perception.hpp"
#include "simulation/road.hpp"

namespace laneloom::commands {

/// Tells of the other traffic as it is seen from a pose, at its stamp, so many seconds after the drive's
/// start. Poses come in the order of stamps. Empty: there is no other traffic.
using Tracker = std::function<TrackedObjects(const VehiclePose& pose, double drive_s)>;

/// The traffic that was annotated in the log that is driven.
inline constexpr const char* kRecordedTraffic = "recorded";

/// Options of `publish` and `simulate` for the road that is driven over, and how it is seen.
struct RoadSource {
  std::string scenario, argoverse2, lanelet2, opendrive;
  double speed_mps = 10.0;
  NoiseOption noise{.name = "none"};
  std::string traffic;  ///< a profile, or kRecordedTraffic; empty: none
  std::uint64_t seed = 1;
  bool strict = false;

  /// One source per log if a directory of several logs is given, or else this one alone.
  std::vector<RoadSource> each() const;
  /// Loads the road, and warns of what is wrong with it and was left out. Throws std::runtime_error or
  /// std::invalid_argument naming the problem with the road, or if there are several.
  simulation::Road load() const;
  simulation::Perception perception(const simulation::Road& road) const;
  /// Empty also where the log has no annotations. Throws std::runtime_error where traffic is recorded, and
  /// the road is no log.
  Tracker tracker(const simulation::Road& road) const;
};

/// Adds --scenario, --argoverse2, --lanelet2 and --opendrive, of which one is needed, and --speed, --noise,
/// --no-field-of-view, --traffic, --seed and --strict.
void add_road_source(CLI::App& command, RoadSource& source);

}  // namespace laneloom::commands
