#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/boundaries/boundary_pairs.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom::lanes {

/// Finds lanes on roads without lines, ours. A boundary is inferred between two boundaries, confirmed or
/// continued, that leave room for two lanes, with no lane, edge or confirmed line between them. At least one
/// of the two is an edge, or a line along one. The inferred boundary continues a line that begins or ends
/// there, or else lies in the middle. A strip between roads with lanes is not divided. The lanes are added to
/// `taken`. The boundaries have no ids.
std::vector<InferredBoundary> divide_unmarked(const std::vector<boundaries::BoundaryPair>& pairs,
                                              const boundaries::Boundaries& boundaries,
                                              const LaneConfig& config, TakenSpace& taken);

}  // namespace laneloom::lanes
