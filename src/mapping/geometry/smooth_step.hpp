#pragma once

#include <algorithm>

namespace laneloom::geometry {

/// Goes from 0 to 1 while `share` does, without a slope at either end (a base of Hermite's).
inline double smooth_step(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace laneloom::geometry
