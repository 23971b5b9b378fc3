#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/topology/road_graph.hpp"

namespace laneloom::topology {

/// Links lanes that continue one another outside of intersections (paper, Sec. III-D-4): the next lane along
/// a shared boundary, and lanes whose ends are aligned. A pair is linked once, rather by a shared boundary
/// than by alignment. The linkages are sorted by ascending ids. Across a gap, the path keeps beside the
/// shared boundary (ours), because traffic does so round a corner.
RoadGraph link_lanes(lanes::LaneLayout layout, const LinkageConfig& config);

}  // namespace laneloom::topology
