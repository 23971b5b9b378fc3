#pragma once

#include <map>
#include <vector>

#include "mapping/topology/driven_linkages.hpp"
#include "mapping/topology/road_graph.hpp"

namespace laneloom::topology {

/// The way that the vehicle took through the lanes.
struct EgoTrack {
  ElementId lane = kNoElement;  ///< the lane that the vehicle was in last
  std::vector<LaneStep> steps;  ///< each once, between lanes that are still in the map

  /// Forgets what was driven in lanes that run the other way now.
  void forget(const std::map<ElementId, ElementId>& renamed) {
    std::erase_if(steps,
                  [&](const LaneStep& s) { return renamed.contains(s.first) || renamed.contains(s.second); });
    if (renamed.contains(lane)) lane = kNoElement;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(lane, steps);
  }
};

/// Follows the vehicle. If it left one lane and came into another that is neither beside the first nor linked
/// to it, the two are linked, because the way has been driven. A linkage across an intersection that was
/// inferred is confirmed if it was driven. Ours, beyond the paper.
void link_ego_track(const Eigen::Isometry3d& T_map_body, EgoTrack& track, RoadGraph& road);

}  // namespace laneloom::topology
