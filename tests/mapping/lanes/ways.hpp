#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "laneloom/way.hpp"
#include "mapping/shapes.hpp"

/// Lanes with borders, ways through them, and what a test asks of a way.
namespace laneloom::test {

inline Polyline shifted(const Polyline& line, double left_m) {
  Polyline out;
  const MeasuredPolyline measured(line);
  for (const double arc_m : arc_lengths(line)) {
    const Eigen::Vector2d along = measured.chord(arc_m - 0.5, arc_m + 0.5);
    out.emplace_back(measured.at(arc_m) + left_m * Point(-along.y(), along.x(), 0.0));
  }
  return out;
}

/// A lane, 3.5 m wide, between borders of its own.
inline Lane road_lane(ElementId id, const Polyline& centerline) {
  Lane result = lane(id, centerline);
  result.left = shifted(centerline, 1.75);
  result.right = shifted(centerline, -1.75);
  return result;
}

inline Lane road_lane(ElementId id, const Point& from, const Point& to) {
  return road_lane(id, straight(from, to, 1 + static_cast<int>((to - from).norm())));
}

inline Linkage link(ElementId from, ElementId to, Linkage::Turn turn = Linkage::Turn::straight,
                    Polyline path = {}) {
  return {.from = from, .to = to, .turn = turn, .probability = 0.5, .path = std::move(path)};
}

inline Way way_on(const LocalMap& map, const Eigen::Isometry3d& T_map_body, WayWish wish = WayWish::straight,
                  const Way* before = nullptr, const WayOptions& options = {}) {
  return way_ahead(LaneGraph(map), T_map_body, wish, before, options).value_or(Way{});
}

inline std::vector<ElementId> ids(const Way& way) {
  std::vector<ElementId> result;
  for (const WayLane& one : way.lanes) result.push_back(one.id);
  return result;
}

inline Polyline points(const Way& way) {
  Polyline line;
  for (const WayStation& station : way.stations) line.push_back(station.point);
  return line;
}

/// The largest angle between directions `within_m` apart, in degrees.
inline double largest_kink_deg(const Way& way, double within_m) {
  double largest = 0.0;
  const auto apart = static_cast<std::size_t>(within_m / way.step_m);
  for (std::size_t i = 0; i + apart < way.stations.size(); ++i)
    largest =
        std::max(largest, std::abs(cross(way.stations[i].direction(), way.stations[i + apart].direction())));
  return std::asin(largest) * 180.0 / std::numbers::pi;
}

inline double largest_curvature_per_m(const Way& way) {
  double largest = 0.0;
  for (const WayStation& station : way.stations)
    largest = std::max(largest, std::abs(station.curvature_per_m));
  return largest;
}

}  // namespace laneloom::test
