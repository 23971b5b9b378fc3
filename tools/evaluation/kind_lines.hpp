#pragma once

#include <vector>

#include "evaluation/evaluation.hpp"
#include "simulation/road.hpp"

/// The lines that are compared: truth, single detections and fused maps as lines of a kind, in the map frame.
namespace laneloom::evaluation {

/// The centerlines of the lane_chains(), then the markings, both in their order.
std::vector<KindLine> kind_lines(const simulation::Road& truth);

/// The stoplines, the boundaries without inferred ones (nothing is painted there), and the lane_chains().
std::vector<KindLine> kind_lines(const LocalMap& map);

/// The detections with at least `min_confidence`. There are no lanes among them.
std::vector<KindLine> kind_lines(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                                 double min_confidence);

}  // namespace laneloom::evaluation
