#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/topology/road_graph.hpp"

namespace laneloom {

/// Which lane continues which, outside of intersections (paper, Sec. III-D-4): the next lane along a shared
/// boundary, and lanes whose ends are aligned. Each pair once, a shared boundary before an alignment; by
/// ascending ids. Across a gap, the path keeps beside the shared boundary (ours): round a corner, that is
/// where the traffic turns.
RoadGraph link_lanes(LaneLayout layout, const LinkageConfig& config);

}  // namespace laneloom
