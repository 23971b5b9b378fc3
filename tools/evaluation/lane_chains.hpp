#pragma once

#include <vector>

#include "laneloom/types.hpp"
#include "simulation/road.hpp"

/// Chains of lanes that only continue one another. They are compared as one, because truth and map may cut
/// lanes at different places.
namespace laneloom::evaluation {

/// A chain of lanes of the truth. It points into the truth.
using LaneChain = std::vector<const simulation::RoadLane*>;

/// The chains of the lanes outside of intersections that a marking bounds on at least one side, since others
/// can not be seen. They are sorted by the ids of their first lanes.
std::vector<LaneChain> lane_chains(const simulation::Road& truth);
Polyline centerline(const LaneChain& chain);

/// A chain of published lanes. It points into the map.
struct PublishedChain {
  std::vector<const Lane*> lanes;
  Polyline centerline;                  ///< with the paths between them; map frame
  ElementId id = kNoElement;            ///< of the longest lane
  double existence_probability = -1.0;  ///< mean along the lanes that tell theirs; -1: none does
};

/// The chains of a map. Two lanes are joined if a boundary or their geometry links them, and neither has
/// another linkage there. Chains are sorted by the ids of their first lanes.
std::vector<PublishedChain> lane_chains(const LocalMap& map);

}  // namespace laneloom::evaluation
