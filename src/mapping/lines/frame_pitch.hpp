#pragma once

#include <vector>

#include "laneloom/types.hpp"
#include "mapping/lines/association.hpp"

namespace laneloom::lines {

/// The distance ahead from which on a frame is stretched. Nearer detections hardly depend on the pitch.
inline constexpr double kPitchPivot_m = 8.0;

/// Estimates by which share a frame is stretched, per metre ahead of the pivot. A frame that was laid on flat
/// ground with a wrong pitch is stretched. It is told from the frame alone, whose lines should run side by
/// side. Robust against outliers. 0: nothing tells the stretch.
double estimate_stretch_per_m(const std::vector<SampledDetection>& detections,
                              const Eigen::Isometry3d& T_map_body);

/// The horizontal offset, map frame, by which that stretch moves a place of the map.
Eigen::Vector2d stretched_by(double stretch_per_m, const Point& point, const Eigen::Isometry3d& T_map_body);

/// Takes a stretch out of the detections.
void unstretch(double stretch_per_m, const Eigen::Isometry3d& T_map_body,
               std::vector<SampledDetection>& detections);

}  // namespace laneloom::lines
