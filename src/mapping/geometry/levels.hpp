#pragma once

#include <cmath>

#include "laneloom/types.hpp"

namespace laneloom::geometry {

/// Greatest difference in height within one road.
inline constexpr double kLevel_m = 2.0;

/// Whether two places that coincide seen from above may be on one road, rather than one on a bridge and one
/// below it.
inline bool same_level(const Point& a, const Point& b) { return std::abs(a.z() - b.z()) <= kLevel_m; }

/// Greatest height of a vehicle's origin above its road: a roof of a truck. A road below a bridge is further
/// down.
inline constexpr double kMaxOrigin_m = 5.0;

/// Whether a vehicle may drive on a place.
inline bool may_drive_on(const Point& road, const Point& vehicle) {
  const double above_m = vehicle.z() - road.z();
  return -kLevel_m <= above_m && above_m <= kMaxOrigin_m;
}

/// The place of a vehicle at the height of its road.
inline Point lowered(const Point& vehicle, const Point& road) { return {vehicle.x(), vehicle.y(), road.z()}; }

}  // namespace laneloom::geometry
