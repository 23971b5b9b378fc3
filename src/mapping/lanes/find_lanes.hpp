#pragma once

#include "laneloom/config.hpp"
#include "mapping/boundaries/road_sections.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom::lanes {

/// Finds the lanes of a road: lanes between boundaries (paper, Sec. III-D-3) without the shoulders,
/// cut at forks, and inferred lanes on roads without lines and beside single lines.
FoundLanes find_lanes(boundaries::SectionGraph road, const geometry::Scene& scene, const LaneConfig& config);

}  // namespace laneloom::lanes
