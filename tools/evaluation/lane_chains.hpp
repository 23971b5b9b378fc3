#pragma once

#include <vector>

#include "laneloom/types.hpp"
#include "simulation/road.hpp"

/// Lanes that only continue one another, as one: neither truth nor map need cut them where the other does.
namespace laneloom {

/// Lanes of the truth. Points into it.
using LaneChain = std::vector<const RoadLane*>;

/// Of the lanes outside of intersections that a marking bounds on one side at least (nobody could see
/// others), by the ids of their first ones.
std::vector<LaneChain> lane_chains(const Road& truth);
Polyline centerline(const LaneChain& chain);

/// Published lanes. Points into the map.
struct PublishedChain {
  std::vector<const Lane*> lanes;
  Polyline centerline;                  ///< with the paths between them; map frame
  ElementId id = kNoElement;            ///< of the longest lane
  double existence_probability = -1.0;  ///< mean along those that tell theirs; -1: none does
};

/// Joined are lanes that a boundary or their geometry links, each the only one that the other is linked with;
/// by the ids of their first ones.
std::vector<PublishedChain> lane_chains(const LocalMap& map);

}  // namespace laneloom
