#pragma once

#include <vector>

#include "evaluation/evaluation.hpp"
#include "simulation/road.hpp"

/// What is compared: truth, single detections and fused maps as lines of a kind, in the map frame.
namespace laneloom {

/// The centerlines of the lane_chains(), then the markings, both in their order.
std::vector<KindLine> kind_lines(const Road& truth);

/// The stoplines, the boundaries but those that are inferred (nothing is painted there), and the
/// lane_chains().
std::vector<KindLine> kind_lines(const LocalMap& map);

/// The detections with at least `min_confidence`; they know no lanes.
std::vector<KindLine> kind_lines(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                                 double min_confidence);

}  // namespace laneloom
