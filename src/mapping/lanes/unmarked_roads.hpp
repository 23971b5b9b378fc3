#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/boundaries/boundary_pairs.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom {

/// Lanes on roads without lines, ours: where confirmed boundaries, one of them at least an edge or a line
/// along one, leave room for two lanes, and no lane, edge or confirmed line lies between them, the boundary
/// between the two is inferred. It continues a line that begins or ends there; else it lies in the middle.
/// What lies between roads with lanes is none. The space is `taken` then. Without ids.
std::vector<InferredBoundary> divide_unmarked(const std::vector<BoundaryPair>& pairs,
                                              const Boundaries& boundaries, const LaneConfig& config,
                                              TakenSpace& taken);

}  // namespace laneloom
