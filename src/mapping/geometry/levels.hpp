#pragma once

#include <cmath>

#include "laneloom/types.hpp"

namespace laneloom::geometry {

/// Greatest difference in height within one road.
inline constexpr double kLevel_m = 2.0;

/// Whether two places that coincide seen from above may be on one road, rather than one on a bridge and one
/// below it.
inline bool same_level(const Point& a, const Point& b) { return std::abs(a.z() - b.z()) <= kLevel_m; }

}  // namespace laneloom::geometry
