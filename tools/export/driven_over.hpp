#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// The markings without the stretches of roadedges that the body of the vehicle passed over: no edge is
/// there. What remains of such a roadedge is a marking per stretch of 2 m or more, and ids count from 1 on.
/// Markings and poses are in the map frame; poses are 5 m apart at most within one pass.
std::vector<Marking> without_edges_driven_over(const std::vector<Marking>& markings,
                                               const std::vector<Eigen::Isometry3d>& poses);

}  // namespace laneloom
