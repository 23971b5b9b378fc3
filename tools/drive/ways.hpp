#pragma once

#include <vector>

#include "laneloom/lane_graph.hpp"

/// The ways that a driver sees in the lanes of a map.
namespace laneloom::drive {

/// The passages from the end of a lane. They have a path also across gaps for which the map gives none.
std::vector<Passage> passages(const LaneGraph& graph, const DirectedLane& lane);

/// A lane beside `lane` to change to if `lane` narrows and ends. It has the same sense, is not known to be
/// oncoming, lies across a boundary that may be crossed, and goes on for longer. Its lane is null if there is
/// none.
DirectedLane lane_to_change_to(const LaneGraph& graph, const DirectedLane& lane);

}  // namespace laneloom::drive
