#pragma once

#include <string>

#include "evaluation/later.hpp"
#include "evaluation/steadiness.hpp"
#include "laneloom/config.hpp"

namespace laneloom::commands {

/// The input to rate: `in`, mapped with a configuration (empty: the default), or `frames` with the maps of
/// the file `map`.
struct LaterInputs {
  std::string in, config;
  std::string frames, map;
  double min_confidence = PreprocessConfig{}.min_confidence;  ///< of the single detections that count
  bool strict = false;                                        ///< the first thing that is wrong is an error
};

/// How accurate the maps of a drive are, and how steady for a planner.
struct LaterRating {
  evaluation::LaterMeter later;
  evaluation::SteadinessMeter steadiness;
};

/// Rates a drive by detections that were seen later. Throws as evaluation/inputs.hpp if a file cannot be
/// read.
LaterRating evaluate_later(const LaterInputs& inputs);

}  // namespace laneloom::commands
