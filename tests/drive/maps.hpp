#pragma once

#include <cmath>
#include <vector>

#include "laneloom/types.hpp"

/// Maps made by hand.
namespace laneloom {

/// `left_m` beside a line, at every point.
inline Polyline beside_line(const Polyline& line, double left_m) {
  Polyline out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::size_t from = i + 1 < line.size() ? i : i - 1;
    const Eigen::Vector2d along = (line[from + 1] - line[from]).head<2>().normalized();
    out.emplace_back(line[i] + left_m * Point(-along.y(), along.x(), 0.0));
  }
  return out;
}

inline Lane lane_of(ElementId id, const Polyline& centerline, double width_m = 3.5) {
  Lane lane;
  lane.id = id;
  lane.centerline = centerline;
  lane.left = beside_line(centerline, 0.5 * width_m);
  lane.right = beside_line(centerline, -0.5 * width_m);
  lane.width_m = width_m;
  return lane;
}

/// Metre by metre.
inline Polyline straight_line(const Point& from, const Point& to) {
  const int steps = static_cast<int>(std::ceil((to - from).norm()));
  Polyline line;
  for (int i = 0; i <= steps; ++i) line.emplace_back(from + (to - from) * i / steps);
  return line;
}

/// To the left from the origin, which it leaves along x; metre by metre.
inline Polyline left_arc(double radius_m, double turn_rad) {
  const int steps = static_cast<int>(std::ceil(radius_m * turn_rad));
  Polyline line;
  for (int i = 0; i <= steps; ++i) {
    const double angle = turn_rad * i / steps;
    line.emplace_back(radius_m * std::sin(angle), radius_m * (1.0 - std::cos(angle)), 0.0);
  }
  return line;
}

inline Linkage link(ElementId from, ElementId to, Linkage::Turn turn = Linkage::Turn::unknown,
                    Polyline path = {}) {
  Linkage linkage;
  linkage.from = from;
  linkage.to = to;
  linkage.turn = turn;
  linkage.path = std::move(path);
  return linkage;
}

}  // namespace laneloom
