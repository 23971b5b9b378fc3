#pragma once

#include "mapping/geometry/map_box.hpp"
#include "mapping/lanes/hypotheses.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom::lanes {

/// The lanes of a road: the hypotheses with the greatest sums of log odds that do not overlap.
/// `boundaries` and `forks` stay empty.
FoundLanes choose_lanes(const boundaries::SectionGraph& road, const geometry::MapBox& box,
                        const Driven& driven, const KnownRoad& known, const LaneConfig& config);

}  // namespace laneloom::lanes
