#pragma once

#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::lanes {

/// A smooth line through points that are about one step apart. The sum of weighted squared distances from
/// the points and of the squared changes of curvature is least. So noise goes, and arcs stay. A point's
/// weight is 0 to 1. Linear in the number of points.
Polyline smooth_line(const Polyline& points, const std::vector<double>& weights);

}  // namespace laneloom::lanes
