#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/types.hpp"

/// Areas as triangles: three indices of points each. Pure functions.
namespace laneloom {

/// Between two lines of the same direction, at least two points each; the points are those of `left`, then
/// those of `right`.
std::vector<std::uint32_t> strip_triangles(const Polyline& left, const Polyline& right);

/// Of a polygon; none where it is not convex, seen from above.
std::vector<std::uint32_t> convex_triangles(const Polyline& outline);

}  // namespace laneloom
