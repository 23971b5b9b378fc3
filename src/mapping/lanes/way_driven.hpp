#pragma once

#include "laneloom/lane_graph.hpp"

/// Ways go on along the paths of others.
namespace laneloom::lanes {

/// A path that others drove, from a place on, up to the lane that it leads into.
struct DrivenPassage {
  Polyline path;                  ///< empty: nobody drove on
  double lateral_stddev_m = 0.0;  ///< of the path
  DirectedLane to;                ///< no lane: the path leads into none that is known
};

/// Others drove on from the end of a lane or of a passage, with the wished turn. Straight on, they kept to
/// the line ahead over the first metres. `ahead` is the direction at that end, of unit length.
DrivenPassage driven_on(const LaneGraph& graph, const Point& end, const Eigen::Vector2d& ahead,
                        Linkage::Turn turn);

}  // namespace laneloom::lanes
