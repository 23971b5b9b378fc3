#pragma once

#include "laneloom/lane_graph.hpp"

/// Ways go on along the paths of others, and as streets do.
namespace laneloom::lanes {

/// A path without a lane, from a place on, up to the lane that it leads into.
struct PathAhead {
  Polyline path;                  ///< empty: there is none
  double lateral_stddev_m = 0.0;  ///< of the path, at its begin
  double stddev_per_m = 0.0;      ///< by which that grows along the path
  Linkage::Turn turn = Linkage::Turn::straight;
  DirectedLane to;  ///< no lane: the path leads into none that is known
};

/// Others drove on from the end of a lane or of a passage, with the wished turn. Straight on, they kept to
/// the line ahead over the first metres. `ahead` is the direction at that end, of unit length.
PathAhead driven_on(const LaneGraph& graph, const Point& end, const Eigen::Vector2d& ahead,
                    Linkage::Turn turn);

/// The map's own way goes on as the street of an SD map does, and leads past the end of a lane or of a
/// passage. `ahead` is as above.
PathAhead street_on(const LaneGraph& graph, const Point& end, const Eigen::Vector2d& ahead);

}  // namespace laneloom::lanes
