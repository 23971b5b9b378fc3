#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/types.hpp"

/// Areas as triangles: three indices of points each. Pure functions.
namespace laneloom::scene {

/// Triangles between two lines of the same direction, of at least two points each. Indices count the points
/// of `left`, then those of `right`.
std::vector<std::uint32_t> strip_triangles(const Polyline& left, const Polyline& right);

/// Triangles of a polygon. Empty: the polygon is not convex, seen from above.
std::vector<std::uint32_t> convex_triangles(const Polyline& outline);

}  // namespace laneloom::scene
