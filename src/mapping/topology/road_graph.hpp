#pragma once

#include <vector>

#include "mapping/lanes/lane_layout.hpp"

namespace laneloom {

/// Lanes, and which of them continue which.
struct RoadGraph : LaneLayout {
  std::vector<Linkage> linkages;  ///< between lanes that are there

  /// By the ids of the lanes, then by kind.
  void sort_linkages();
  /// Lets lanes run the other way, with their sides and neighbours, and the linkages between them. A linkage
  /// of which one lane is turned and the other is not goes.
  void turn(const std::vector<ElementId>& ids);
};

}  // namespace laneloom
