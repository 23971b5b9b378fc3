#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "evaluation/evaluation.hpp"
#include "replay/replay.hpp"
#include "support/stage_timer.hpp"

namespace laneloom {

/// What came of one configuration's replay.
struct ReplayResult {
  std::string name;  ///< of the configuration
  StageTimer timer;
  double elapsed_s = 0.0;  ///< with reading and writing
  std::string hash;
  Counters counters;
  std::size_t pending = 0;                                        ///< frames whose poses never came
  std::size_t maps = 0, boundaries = 0, lanes = 0, linkages = 0;  ///< summed over the maps
  std::int64_t first_ns = 0, last_ns = 0;                         ///< stamps
  std::string advice;                                             ///< where nothing came of it: why
  LiveComparison comparison;
  MapScore score;

  void add(const LocalMap& map);
  void add_live(const AnyMessage& message);
};

void print_result(const ReplayResult& result);
/// Side by side.
void print_comparison(const std::vector<ReplayResult>& results);
/// As JSON; of several results, under "configurations". Throws std::runtime_error where it cannot be written.
void write_report(const std::string& path, const std::vector<ReplayResult>& results);

}  // namespace laneloom
