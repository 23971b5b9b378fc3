#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/boundary_pairs.hpp"

namespace laneloom::lanes {

/// Finds lanes between a boundary and the next two on its right (paper, Sec. III-D-3), where the distance
/// lies within the configured limits and varies little over a long enough range. Nearer boundaries come
/// first, so that lanes do not overlap. Neither a gore is a lane, nor a strip between two edges of which one
/// bounds the lanes of a road on its other side. A lane runs as its boundaries do, or as the older one if the
/// two are opposed. The lanes have no ids and neighbours, and a deterministic order.
std::vector<Lane> generate_lanes(const std::vector<boundaries::BoundaryPair>& pairs,
                                 const boundaries::Boundaries& boundaries, const Point& vehicle,
                                 const LaneConfig& config);

}  // namespace laneloom::lanes
