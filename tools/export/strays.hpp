#pragma once

#include <cstddef>
#include <set>
#include <utility>

#include "export/road_network.hpp"

namespace laneloom::exports {

/// A lanelet with a direction in which it may be driven.
struct DirectedLanelet {
  std::size_t lanelet = 0;
  bool backwards = false;  ///< from its end to its beginning, if its direction is not known
  bool operator<(const DirectedLanelet& other) const {
    return std::pair(lanelet, backwards) < std::pair(other.lanelet, other.backwards);
  }
};

/// Pairs of lanelets of which the second follows the first, by shared nodes alone, as Lanelet2 reads them.
std::set<std::pair<DirectedLanelet, DirectedLanelet>> followers(const RoadNetwork& network);

/// Separates lanelets that follow each other by their nodes, but not by the map: the lanelet that is followed
/// gets nodes of its own at its end.
void separate_strays(const LocalMap& map, RoadNetwork& network);

}  // namespace laneloom::exports
