#pragma once

#include <cstddef>
#include <set>
#include <utility>

#include "export/road_network.hpp"

namespace laneloom {

/// A lanelet as it may be driven.
struct DirectedLanelet {
  std::size_t lanelet = 0;
  bool backwards = false;  ///< from its end to its begin: its direction is not known
  bool operator<(const DirectedLanelet& other) const {
    return std::pair(lanelet, backwards) < std::pair(other.lanelet, other.backwards);
  }
};

/// What follows what, by shared nodes alone, as Lanelet2 has it.
std::set<std::pair<DirectedLanelet, DirectedLanelet>> followers(const RoadNetwork& network);

/// Takes apart what follows by its nodes, but not by the map: the one that is followed gets nodes of its own
/// at its end.
void separate_strays(const LocalMap& map, RoadNetwork& network);

}  // namespace laneloom
