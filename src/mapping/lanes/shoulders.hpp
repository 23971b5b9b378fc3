#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/boundary_pairs.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"

namespace laneloom::lanes {

/// Removes lanes that are shoulders or cycle lanes. Such a lane is narrow and lies between an edge and the
/// solid line of a wider lane, on whose other side the road goes on. (If the road ends there too, the two are
/// the lanes of a narrow road.) A lane along the same side of a boundary as the lane that the vehicle drives
/// in is no shoulder. Ours. `pairs` are all pairs that the lanes were made of.
std::vector<Lane> without_shoulders(const std::vector<Lane>& lanes,
                                    const std::vector<boundaries::BoundaryPair>& pairs,
                                    const boundaries::Boundaries& boundaries,
                                    const Eigen::Isometry3d& T_map_body, const LaneConfig& config);

}  // namespace laneloom::lanes
