#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/lane_boundaries.hpp"

namespace laneloom {

/// Takes out the lanes that are shoulders or cycle lanes: narrow, between an edge and the solid line of a
/// wider lane, which has a line on its other side as well. (Where that has an edge there, they are the two
/// lanes of a narrow road.) Where the vehicle drives is a lane. Ours. `boundaries` are in the order of their
/// ids.
void remove_shoulders(const std::vector<LaneBoundary>& boundaries, const Eigen::Isometry3d& T_map_body,
                      const LaneConfig& config, std::vector<Lane>& lanes);

}  // namespace laneloom
