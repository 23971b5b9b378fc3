#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

struct WeightedPoint {
  Point point = Point::Zero();
  double weight = 1.0;
};

/// The polyline through a marking's voxels (paper, Sec. III-C-2): two points for a stopline; divided along
/// the first principal component where the points spread along it alone; else in each quadrant of the first
/// two components, with shorter segments. Its direction is arbitrary. Empty for fewer than two points.
Polyline estimate_polyline(const std::vector<WeightedPoint>& points, MarkingType type,
                           const PolylineConfig& config);

}  // namespace laneloom
