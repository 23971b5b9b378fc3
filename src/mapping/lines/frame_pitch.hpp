#pragma once

#include <vector>

#include "laneloom/types.hpp"
#include "mapping/lines/association.hpp"

namespace laneloom {

/// Where a frame is stretched about: what a network says of nearer places hardly depends on the pitch.
inline constexpr double kPitchPivot_m = 8.0;

/// By how much a frame is stretched per metre ahead of the pivot, as one is that was laid on flat ground with
/// a wrong pitch. Told from the frame alone: that its lines run side by side. Robust; 0 where nothing tells.
double estimate_stretch_per_m(const std::vector<SampledDetection>& detections,
                              const Eigen::Isometry3d& T_map_body);

/// How far a place of the map lies from where it would without that stretch, horizontally.
Eigen::Vector2d stretched_by(double stretch_per_m, const Point& point, const Eigen::Isometry3d& T_map_body);

/// Takes a stretch out of the detections.
void unstretch(double stretch_per_m, const Eigen::Isometry3d& T_map_body,
               std::vector<SampledDetection>& detections);

}  // namespace laneloom
