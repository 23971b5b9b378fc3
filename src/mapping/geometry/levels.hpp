#pragma once

#include <cmath>

#include "laneloom/types.hpp"

namespace laneloom {

inline constexpr double kLevel_m = 2.0;

/// Whether two places that coincide from above may be on one road, and not on a bridge and below it.
inline bool same_level(const Point& a, const Point& b) { return std::abs(a.z() - b.z()) <= kLevel_m; }

}  // namespace laneloom
