#pragma once

namespace laneloom {

/// Where on earth the map frame's origin is: x points east, y north, on the tangent plane there. WGS84.
struct Origin {
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

}  // namespace laneloom
