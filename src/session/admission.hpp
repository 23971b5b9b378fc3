#pragma once

#include <cstddef>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::session {

/// Bounds the work that a frame makes. If a frame has more detections than max_frame_detections, or more
/// metres of markings than max_frame_length_m, the least trusted detections are left out, and of equally
/// trusted ones the farthest. The others keep their order. Returns how many were left out.
std::size_t admit(const GateConfig& config, DetectionFrame& frame);

/// The length of all markings of a frame together, in metres. The work that a frame makes grows with it.
double length_of_markings(const DetectionFrame& frame);

}  // namespace laneloom::session
