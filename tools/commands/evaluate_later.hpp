#pragma once

#include <string>

#include "evaluation/later.hpp"

namespace laneloom {

/// What to rate: `in` as mapped with a configuration (none: the default), or the maps that a file holds.
struct LaterInputs {
  std::string in, config;
  std::string frames, map;
  double min_confidence = 0.0;
};

/// Rates a drive by what was seen later. Throws std::runtime_error where nothing was, and as
/// evaluation/inputs.hpp where a file cannot be read.
LaterMeter evaluate_later(const LaterInputs& inputs);

}  // namespace laneloom
