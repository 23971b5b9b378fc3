#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/boundaries/road_sections.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom::lanes {

/// Finds lanes beside a single line, ours. They lie on a side of a confirmed line where nothing else was
/// seen, as far as a lane with room to park would reach. The line is dashed there, or the vehicle drives
/// beside it as in a lane. An edge counts where the vehicle drives, on a road without confirmed lanelines.
/// The lane's other boundary is inferred, at the assumed width and within the range. A lane is at least 8 m
/// long. Between two stretches where something else was seen it is at least 20 m long, since a shorter one
/// may be a gap in that. The lanes are added to `taken`. The boundaries have no ids.
std::vector<InferredBoundary> one_sided_lanes(const boundaries::SectionGraph& road,
                                              const geometry::MapBox& box, const LaneConfig& config,
                                              TakenSpace& taken);

}  // namespace laneloom::lanes
