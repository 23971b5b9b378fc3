#pragma once

#include <cstddef>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// Bounds the work that a frame makes. Of a frame with more than max_frame_detections, or more metres of
/// markings than max_frame_length_m, the least trusted detections are left out first, and of equally trusted
/// ones the farthest. Those that stay keep their order. Returns how many were left out.
std::size_t admit(const GateConfig& config, DetectionFrame& frame);

/// The markings of a frame together, in metres: what its work grows with.
double length_of_markings(const DetectionFrame& frame);

}  // namespace laneloom
