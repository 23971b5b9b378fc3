#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "mapping/topology/road_graph.hpp"

namespace laneloom::topology {

/// Whether the next lane along a boundary lies in another street: round a corner, from or into a lane between
/// two edges. Both kerbs of a narrow street go round corners, and traffic keeps to one of them.
bool leads_elsewhere(const Lane& from, const Lane& to, const lanes::LaneLayout& layout);

/// Links lanes that continue one another outside of intersections (paper, Sec. III-D-4): the next lane along
/// a shared boundary, and lanes whose ends are aligned. A pair is linked once, rather by a shared boundary
/// than by alignment. The linkages are sorted by ascending ids. Across a gap, the path keeps beside the
/// shared boundary (ours), because traffic does so round a corner.
RoadGraph link_lanes(lanes::LaneLayout layout, const LinkageConfig& config);

}  // namespace laneloom::topology
