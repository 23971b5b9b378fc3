#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/boundary_pairs.hpp"

namespace laneloom {

/// Lanes between pairs of boundaries (paper, Sec. III-D-3): each boundary with the two next ones on its
/// right, where their distance lies in the configured interval and varies little over a long enough range.
/// The nearer boundary comes first, so that lanes do not overlap; where an edge bounds the lanes of a road,
/// what lies beyond it up to another edge is none; nor is a gore. A lane runs as its boundaries do; of two
/// that are opposed, as the older one. Without ids and neighbours, in a deterministic order.
std::vector<Lane> generate_lanes(const std::vector<BoundaryPair>& pairs, const Boundaries& boundaries,
                                 const Point& vehicle, const LaneConfig& config);

}  // namespace laneloom
