#pragma once

#include "mapping/topology/road_graph.hpp"

namespace laneloom::topology {

/// Lets linked lanes meet. Where the end of one lane and the beginning of the next lie within a short
/// distance, both centerlines are led to one point between them, smoothly over the last metres. Elsewhere the
/// linkage gets a path from the one to the other. A linkage that would lead aside more than ahead is removed.
/// Where the next lane runs on like the one before, a step aside costs probability from 20 degrees on.
void meet_at_joints(RoadGraph& road);

}  // namespace laneloom::topology
