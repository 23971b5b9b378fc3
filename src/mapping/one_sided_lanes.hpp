#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/inferred_boundaries.hpp"
#include "mapping/local_range.hpp"
#include "mapping/road_sections.hpp"

namespace laneloom {

/// Lanes beside one line, ours: where there is nothing else within the width of a lane with room to park, on
/// that side of a confirmed line, and that line is dashed or the vehicle drives along it there. The lane's
/// other boundary is inferred, at the assumed width. The space is `taken` then. Without ids.
std::vector<InferredBoundary> one_sided_lanes(const std::vector<RoadSection>& sections,
                                              const std::vector<LaneBoundary>& boundaries,
                                              const std::vector<MeasuredPolyline>& measured,
                                              const LocalRange& range, const LaneConfig& config,
                                              TakenSpace& taken);

}  // namespace laneloom
