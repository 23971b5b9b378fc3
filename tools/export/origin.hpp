#pragma once

namespace laneloom::exports {

/// The place on earth of the map frame's origin (WGS84). x points east, y north, on the tangent plane there.
struct Origin {
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

}  // namespace laneloom::exports
