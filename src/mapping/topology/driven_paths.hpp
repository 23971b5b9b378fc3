#pragma once

#include <vector>

#include "mapping/geometry/scene.hpp"
#include "mapping/topology/road_graph.hpp"
#include "mapping/topology/traffic.hpp"

namespace laneloom::topology {

/// The paths of others within the box, where neither a lane nor the path of a linkage is. One trail is
/// enough: of several trails along one path, the oldest one tells where it lies. `driven` are the stretches
/// of the trails within lanes. The paths have no ids. Ours.
std::vector<DrivenPath> driven_paths(const std::vector<trails::Trail>& trails,
                                     const std::vector<DrivenStretch>& driven, const RoadGraph& road,
                                     const geometry::MapBox& box);

}  // namespace laneloom::topology
