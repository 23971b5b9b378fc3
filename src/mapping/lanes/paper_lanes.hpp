#pragma once

#include "laneloom/config.hpp"
#include "mapping/boundaries/road_sections.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom::lanes {

/// The lanes of the paper (Sec. III-D-3): between a boundary and the next two on its right, where the
/// distance lies within the configured limits and varies little over a long enough range. Nearer boundaries
/// come first, so that lanes do not overlap. A lane runs as its boundaries do, or as the older one if the two
/// are opposed. Nothing is inferred. The order of the lanes is deterministic.
FoundLanes paper_lanes(boundaries::SectionGraph road, const LaneConfig& config);

}  // namespace laneloom::lanes
