#pragma once

#include <vector>

#include "evaluation/evaluation.hpp"
#include "simulation/road.hpp"

/// What is compared: truth, single detections and fused maps as lines of a kind, in the map frame.
namespace laneloom {

/// Lanes of the truth, each of which only continues the one before.
using LaneChain = std::vector<const RoadLane*>;

/// The lanes that markings bound on both sides (nobody could see others). Those that only continue one
/// another are one chain, since a map need not cut them where the truth does. Points into `truth`.
std::vector<LaneChain> lane_chains(const Road& truth);
Polyline centerline(const LaneChain& chain);

/// The centerlines of the lane chains, then the markings, both in their order.
std::vector<KindLine> kind_lines(const Road& truth);

/// The boundaries, stoplines and lanes.
std::vector<KindLine> kind_lines(const LocalMap& map);

/// The detections with at least `min_confidence`; they know no lanes.
std::vector<KindLine> kind_lines(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                                 double min_confidence);

}  // namespace laneloom
