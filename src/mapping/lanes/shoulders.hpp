#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/boundary_pairs.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"

namespace laneloom {

/// The lanes but those that are shoulders or cycle lanes: narrow, between an edge and the solid line of a
/// wider lane, on whose other side the road goes on. (Where it ends there too, these are the two lanes of a
/// narrow road.) What lies along the same side of a boundary as the lane that the vehicle drives in is none.
/// Ours. `pairs` are all that the lanes were made of.
std::vector<Lane> without_shoulders(const std::vector<Lane>& lanes, const std::vector<BoundaryPair>& pairs,
                                    const Boundaries& boundaries, const Eigen::Isometry3d& T_map_body,
                                    const LaneConfig& config);

}  // namespace laneloom
