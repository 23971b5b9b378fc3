#pragma once

#include <cstdint>
#include <string>

#include "commands/replay_report.hpp"
#include "laneloom/config.hpp"
#include "recording/recording.hpp"

namespace laneloom::commands {

/// The input of a replay, in numbers.
struct ReplayInput {
  std::uint64_t poses = 0, frames = 0, detections = 0;
  double best_confidence = 0.0;

  void add(const recording::AnyMessage& message);
};

/// If a replay gave no map, no marking or no lane, a text that says so and gives a likely reason. Otherwise
/// empty.
std::string advice_on(const ReplayInput& input, const ReplayResult& result, const MapperConfig& config);

}  // namespace laneloom::commands
