#pragma once

#include "laneloom/config.hpp"
#include "mapping/boundaries/road_sections.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom {

/// The lanes of a road: those between boundaries (paper, Sec. III-D-3) but the shoulders, and those that are
/// inferred, on roads without lines and beside one line.
FoundLanes find_lanes(SectionGraph road, const Scene& scene, const LaneConfig& config);

}  // namespace laneloom
