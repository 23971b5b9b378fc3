#pragma once

#include <cmath>

#include "laneloom/types.hpp"

namespace laneloom {

/// Whether two places that coincide from above may be on one road, and not on a bridge and below it.
inline bool same_level(const Point& a, const Point& b) {
  constexpr double kMaxHeight_m = 2.0;
  return std::abs(a.z() - b.z()) <= kMaxHeight_m;
}

}  // namespace laneloom
