#pragma once

#include "export/road_network.hpp"
#include "laneloom/types.hpp"

namespace laneloom::exports {

/// Cuts and welds the lanes of a map, so that shared nodes and ways tell the map's neighbours and linkages. A
/// lane becomes a row of lanelets. Lanes that meet have both nodes in common there; ends that lie up to 2 m
/// beside each other are moved together for this. Any other linkage becomes a lanelet of its own, between
/// virtual lines where it runs along no boundary. It has a turn if it leads across an intersection. Lanes
/// that are not linked share no nodes. `map` must keep the contract of maps.
RoadNetwork weld(const LocalMap& map);

}  // namespace laneloom::exports
