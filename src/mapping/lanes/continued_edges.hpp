#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/geometry/map_box.hpp"

namespace laneloom::lanes {

/// Continues the edges of roads without lines where they are not seen: an edge that ends while the edge
/// across the road goes on is continued beside it, as far away as before. It is continued for at most 30 m,
/// within the box, up to where something else lies or the other edge turns off round a corner. Returns the
/// continuations, of status inferred and without ids. Ours.
std::vector<Marking> continued_edges(const boundaries::Boundaries& boundaries, const geometry::MapBox& box,
                                     const LaneConfig& config);

}  // namespace laneloom::lanes
