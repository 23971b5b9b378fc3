#pragma once

#include <vector>

#include "laneloom/lane_graph.hpp"

/// What a driver makes of the lanes of a map.
namespace laneloom {

/// Where the map leads on from the end of a lane, with a path also across the gaps for which the map gives
/// none.
std::vector<Passage> passages(const LaneGraph& graph, const DirectedLane& lane);

/// A lane beside `lane` to change to where that narrows and ends: same sense, not known to be oncoming,
/// across a boundary that may be crossed, and going on for longer. It is null where there is none.
DirectedLane lane_to_change_to(const LaneGraph& graph, const DirectedLane& lane);

}  // namespace laneloom
