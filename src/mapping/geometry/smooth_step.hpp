#pragma once

#include <algorithm>

namespace laneloom::geometry {

/// Goes from 0 to 1 while `share` does, without a slope at either end (a base of Hermite's).
inline double smooth_step(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// The share of a shift of a line's end that is left at a distance from the end. A shift fades over 60 times
/// its length, and at least 5 m, but within `most_m`.
inline double faded(double distance_m, double shift_m, double most_m) {
  const double over_m = std::min(most_m, std::max(5.0, 60.0 * shift_m));
  return 1.0 - smooth_step(std::min(1.0, distance_m / over_m));
}

}  // namespace laneloom::geometry
