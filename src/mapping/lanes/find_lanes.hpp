#pragma once

#include "laneloom/config.hpp"
#include "mapping/boundaries/road_sections.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/lanes/hypotheses.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom::lanes {

/// Finds the lanes of a road, by the configured method: those of the paper (Sec. III-D-3), or the likeliest
/// ones, cut at forks, with inferred lanes where borders are unseen.
FoundLanes find_lanes(boundaries::SectionGraph road, const geometry::MapBox& box, const Driven& driven,
                      const KnownRoad& known, const LaneConfig& config);

}  // namespace laneloom::lanes
