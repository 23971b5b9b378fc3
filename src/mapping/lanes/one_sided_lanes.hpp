#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/boundaries/road_sections.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom {

/// Lanes beside one line, ours: on a side of a confirmed laneline where nothing else was seen, as far as a
/// lane with room to park would reach, and where the line is dashed, or the vehicle drives beside it as in a
/// lane. The lane's other boundary is inferred, at the assumed width and within the range. A lane is 8 m long
/// at least; between two stretches where there is something, 20 m: what is shorter is a gap in that. The
/// space is `taken` then. Without ids.
std::vector<InferredBoundary> one_sided_lanes(const SectionGraph& road, const MapBox& box,
                                              const LaneConfig& config, TakenSpace& taken);

}  // namespace laneloom
