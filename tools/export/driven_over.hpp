#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::exports {

/// The markings without the stretches of roadedges that the body of the vehicle passed over, since no edge is
/// there. Remaining stretches of 2 m or more become markings of their own. Ids count from 1 on. Markings and
/// poses are in the map frame. Within one pass, poses are at most 5 m apart.
std::vector<Marking> without_edges_driven_over(const std::vector<Marking>& markings,
                                               const std::vector<Eigen::Isometry3d>& poses);

}  // namespace laneloom::exports
