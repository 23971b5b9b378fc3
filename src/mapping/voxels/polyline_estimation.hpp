#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::voxels {

/// The center of a voxel, weighted by its detections.
struct WeightedPoint {
  Point point = Point::Zero();  ///< map frame
  double weight = 1.0;
};

/// The polyline through a marking's voxels (paper, Sec. III-C-2). A stopline gets two points. Points that
/// spread along the first principal component alone are divided along it. Other points are divided in each
/// quadrant of the first two components, into shorter segments. The direction of the line is arbitrary. Empty
/// for fewer than two points.
Polyline estimate_polyline(const std::vector<WeightedPoint>& points, MarkingType type,
                           const PolylineConfig& config);

}  // namespace laneloom::voxels
