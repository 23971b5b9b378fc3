#pragma once

#include <algorithm>
#include <vector>

#include "laneloom/types.hpp"

/// Stretches of a line, by arc length.
namespace laneloom::geometry {

/// The overlap of two stretches. Its length is negative where they do not overlap.
inline Stretch common(const Stretch& a, const Stretch& b) {
  return {std::max(a.from_m, b.from_m), std::min(a.to_m, b.to_m)};
}

/// The same stretch on the reversed line, which is `total_m` long.
inline Stretch reversed(const Stretch& stretch, double total_m) {
  return {total_m - stretch.to_m, total_m - stretch.from_m};
}

inline void reverse(std::vector<Stretch>& stretches, double total_m) {
  std::ranges::reverse(stretches);
  for (Stretch& stretch : stretches) stretch = reversed(stretch, total_m);
}

/// Whether an arc length lies inside one of the stretches, and not at its end.
inline bool contains(const std::vector<Stretch>& stretches, double arc_m) {
  return std::ranges::any_of(stretches, [&](const Stretch& s) { return s.from_m < arc_m && arc_m < s.to_m; });
}

}  // namespace laneloom::geometry
