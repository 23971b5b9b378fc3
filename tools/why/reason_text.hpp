#pragma once

#include <string>
#include <vector>

#include "laneloom/reasons.hpp"

namespace laneloom::why {

/// The frames of the last seconds that observed a line.
struct Sightings {
  std::size_t frames = 0, of = 0;
  double span_s = 0.0;
};

/// What the mapper decided of a line and by which terms, in sentences.
std::vector<std::string> text_of(const LineReason& line, const FrameReasons& frame, const Sightings& lately);

/// The mapper's decision about a lane and its direction, with the terms, in sentences.
std::vector<std::string> text_of(const LaneReason& lane, const FrameReasons& frame);

/// What became of a detection, in a sentence that names the rule's key of the configuration.
std::string text_of(const DetectionFate& detection);

}  // namespace laneloom::why
