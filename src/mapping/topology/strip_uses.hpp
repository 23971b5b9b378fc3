#pragma once

#include <vector>

#include "mapping/topology/road_graph.hpp"
#include "mapping/trails/roadside.hpp"

namespace laneloom::topology {

/// Gives the strips at the side of a road their use, and its probability: by their width, by what bounds
/// them, and by who stands and rides there. A strip that was in the map before, `former`, rather is for what
/// it was. Ours.
void tell_uses(const trails::Roadside& roadside, const std::vector<Lane>& former, RoadGraph& road);

}  // namespace laneloom::topology
