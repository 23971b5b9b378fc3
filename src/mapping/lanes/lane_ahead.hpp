#pragma once

#include <Eigen/Geometry>

#include "laneloom/lane_graph.hpp"

namespace laneloom::lanes {

/// The point at which a lane begins, as it is walked.
const Point& begin_point(const DirectedLane& lane);
/// The direction of a lane there, of unit length.
Eigen::Vector2d begin_direction(const DirectedLane& lane);

/// The lane that begins straight ahead of a vehicle which is in none, at most 20 m away. Lanes that are known
/// to be oncoming, and those behind an edge, are left out. Its `lane` is null: there is none.
DirectedLane lane_ahead(const LaneGraph& graph, const Eigen::Isometry3d& T_map_body);

}  // namespace laneloom::lanes
