#pragma once

#include "laneloom/lane_graph.hpp"

/// Where others drove on from the end of what is known.
namespace laneloom::lanes {

/// A path that others drove, from a place on, up to the lane that it leads into.
struct DrivenPassage {
  Polyline path;    ///< empty: nobody drove on
  DirectedLane to;  ///< no lane: the path leads into none that is known
};

/// The way that others took from the end of a lane or a passage with a turn. `ahead` is its direction there,
/// of unit length.
DrivenPassage driven_on(const LaneGraph& graph, const Point& end, const Eigen::Vector2d& ahead,
                        Linkage::Turn turn);

}  // namespace laneloom::lanes
