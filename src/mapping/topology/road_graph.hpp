#pragma once

#include <map>
#include <vector>

#include "mapping/lanes/lane_layout.hpp"

namespace laneloom::topology {

/// What two lanes tell of a linkage between them: their borders do.
inline Evidence evidence_between(const Lane& from, const Lane& to) {
  return (from.evidence | to.evidence) & (Evidence::markings | Evidence::edges);
}

/// Lanes and the linkages between them.
struct RoadGraph : lanes::LaneLayout {
  std::vector<Linkage> linkages;  ///< only between lanes of this graph

  /// Sorts the linkages by the ids of their lanes, then by kind.
  void sort_linkages();
  /// Lets lanes run the other way, with their sides, neighbours and linkages. A linkage between a lane that
  /// is turned and one that is not is removed.
  void turn(const std::vector<ElementId>& ids);
  /// Gives lanes other ids, by their former ones.
  void rename(const std::map<ElementId, ElementId>& ids);
  /// Lets each side strip run as the lane beside it does, with which it has a border in common, and gives it
  /// the direction of that lane.
  void turn_side_strips();
};

}  // namespace laneloom::topology
