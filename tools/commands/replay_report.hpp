#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "evaluation/evaluation.hpp"
#include "laneloom/config.hpp"
#include "recording/recording.hpp"
#include "replay/replay.hpp"
#include "support/stage_timer.hpp"

namespace laneloom::commands {

/// The input of a replay, in numbers.
struct ReplayInput {
  std::uint64_t poses = 0, frames = 0, detections = 0, objects = 0;  ///< objects: messages
  double best_confidence = 0.0;
  std::set<std::string> sources;  ///< of the frames

  void add(const recording::AnyMessage& message);
};

/// The result of the replay with one configuration.
struct ReplayResult {
  std::string name;  ///< of the configuration
  support::StageTimer timer;
  double elapsed_s = 0.0;  ///< including reading and writing
  std::string hash;
  Counters counters;
  std::size_t pending = 0;                                        ///< number of frames whose poses never came
  std::size_t maps = 0, boundaries = 0, lanes = 0, linkages = 0;  ///< summed over the maps
  std::int64_t first_ns = 0, last_ns = 0;                         ///< stamps of the first and last map
  std::string advice;                                             ///< see advice_on()
  replay::LiveComparison comparison;
  evaluation::MapScore score;

  void add(const LocalMap& map);
  void add_live(const recording::AnyMessage& message);
};

/// If a replay gave no map, no marking or no lane, most of its input was refused, no other vehicle told
/// anything, or a profile was of no use, a text that says so and gives a likely reason. Otherwise empty.
std::string advice_on(const ReplayInput& input, const ReplayResult& result, const MapperConfig& config);

void print_result(const ReplayResult& result);
/// Prints results side by side.
void print_comparison(const std::vector<ReplayResult>& results);
/// Writes the results as JSON; several results are under "configurations". Throws std::runtime_error if the
/// file cannot be written.
void write_report(const std::string& path, const std::vector<ReplayResult>& results);

}  // namespace laneloom::commands
