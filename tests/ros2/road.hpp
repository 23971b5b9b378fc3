#pragma once

#include <string>

#include "laneloom/messages.hpp"

namespace laneloom {

/// From (x, y) as many metres ahead, by metre.
inline Polyline straight(double x_m, double y_m, int length_m) {
  Polyline line;
  for (int i = 0; i <= length_m; ++i) line.emplace_back(x_m + i, y_m, 0.0);
  return line;
}

/// A lane of 4 m along x.
inline Lane lane_at(ElementId id, double x_m, double y_m, int length_m = 10) {
  Lane lane;
  lane.id = id;
  lane.left = straight(x_m, y_m + 2.0, length_m);
  lane.right = straight(x_m, y_m - 2.0, length_m);
  lane.centerline = straight(x_m, y_m, length_m);
  lane.width_m = 4.0;
  return lane;
}

/// A map of the vehicle at (100, 50) that looks along y, with nothing in it.
inline PublishedMap empty_map() {
  PublishedMap map;
  map.frame_id = "map";
  map.state = MapState::ok;
  map.map.stamp_ns = 1'700'000'000'250'000'000;
  map.map.T_map_body = Eigen::Translation3d(100.0, 50.0, 0.0) * Eigen::AngleAxisd(M_PI / 2, Point::UnitZ());
  return map;
}

}  // namespace laneloom
