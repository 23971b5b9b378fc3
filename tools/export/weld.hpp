#pragma once

#include "export/road_network.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// The lanes of a map, cut and welded so that what the map says of neighbours and linkages is in shared nodes
/// and ways. A lane becomes a row of lanelets. Lanes that meet have both nodes in common there, and ends that
/// lie up to 2 m beside each other are moved together for it; any other linkage becomes a lanelet of its own,
/// between virtual lines where it runs along no boundary: one with a turn across an intersection, one without
/// elsewhere. Where no linkage leads, no nodes are shared. `map` keeps the contract of maps.
RoadNetwork weld(const LocalMap& map);

}  // namespace laneloom
