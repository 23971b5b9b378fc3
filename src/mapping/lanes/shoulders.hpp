#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/boundary_pairs.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"

namespace laneloom {

/// Takes out the lanes that are shoulders or cycle lanes: narrow, between an edge and the solid line of a
/// wider lane, on whose other side the road goes on. (Where it ends there too, these are the two lanes of a
/// narrow road.) What lies along the same side of a boundary as the lane that the vehicle drives in is none.
/// Ours. `boundaries` are in the order of their ids, `pairs` all that the lanes were made of.
void remove_shoulders(const std::vector<BoundaryPair>& pairs, const std::vector<LaneBoundary>& boundaries,
                      const Eigen::Isometry3d& T_map_body, const LaneConfig& config,
                      std::vector<Lane>& lanes);

}  // namespace laneloom
