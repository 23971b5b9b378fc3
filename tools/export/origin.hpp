#pragma once

#include "laneloom/basics.hpp"

namespace laneloom::exports {

/// The place on earth (WGS84) of a place of the map frame, its origin as a rule. x points east, y north, on
/// the tangent plane there.
struct Origin {
  double latitude_deg = 0.0, longitude_deg = 0.0;
  Point of = Point::Zero();
};

}  // namespace laneloom::exports
