#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lines/line_map.hpp"

/// Lines and frames with known geometry.
namespace laneloom::test {

inline Polyline straight(const Point& from, const Point& to, int points = 2) {
  Polyline line;
  for (int i = 0; i < points; ++i)
    line.push_back(from + (to - from) * (static_cast<double>(i) / (points - 1)));
  return line;
}

/// An arc about `center`, counter-clockwise where to_deg > from_deg, with a vertex about every 0.25 m.
inline Polyline arc(const Point& center, double radius_m, double from_deg, double to_deg) {
  const double from_rad = from_deg * std::numbers::pi / 180.0;
  const double sweep_rad = (to_deg - from_deg) * std::numbers::pi / 180.0;
  const int steps = std::max(2, static_cast<int>(std::abs(sweep_rad) * radius_m / 0.25));
  Polyline line;
  for (int i = 0; i <= steps; ++i) {
    const double angle_rad = from_rad + sweep_rad * i / steps;
    line.push_back(center + radius_m * Point(std::cos(angle_rad), std::sin(angle_rad), 0.0));
  }
  return line;
}

inline Detection detection(MarkingType type, Polyline points, MarkingStyle style = MarkingStyle::unknown) {
  return {.type = type, .style = style, .confidence = 0.9, .points = std::move(points)};
}

inline Marking marking(ElementId id, Polyline points, MarkingType type = MarkingType::laneline) {
  return {.id = id, .type = type, .points = std::move(points)};
}

inline boundaries::LaneBoundary boundary(ElementId id, Polyline points,
                                         MarkingType type = MarkingType::laneline) {
  return {marking(id, std::move(points), type), {id}};
}

inline Lane lane(ElementId id, Polyline centerline) {
  return {.id = id, .centerline = std::move(centerline), .width_m = 3.5};
}

inline Lane lane(ElementId id, const Point& from, const Point& to) { return lane(id, straight(from, to)); }

/// A line with a station at every vertex.
inline lines::Line line(ElementId id, const Polyline& points, MarkingType type = MarkingType::laneline) {
  lines::Line result{.id = id, .stations = {}};
  for (const Point& point : points) {
    result.stations.push_back({.position = point, .lateral = lines::LateralFilter({.stddev_m = 1.0})});
    result.stations.back().type_votes[index(type)] = 1.0;
  }
  return result;
}

/// The largest distance of the vertices of `line` from `truth`.
inline double max_distance(const Polyline& line, const Polyline& truth) {
  const MeasuredPolyline measured(truth);
  double largest_m = 0.0;
  for (const Point& point : line) largest_m = std::max(largest_m, measured.project(point).distance_m);
  return largest_m;
}

inline Eigen::Isometry3d at(double x, double y = 0.0, double yaw_rad = 0.0) {
  return Eigen::Translation3d(x, y, 0.0) * Eigen::AngleAxisd(yaw_rad, Point::UnitZ());
}

/// About a vehicle at the origin; the stamp is the number of the frame.
inline geometry::Scene scene(std::uint64_t frame) {
  return {.box = geometry::MapBox({}, at(0)), .stamp_ns = static_cast<std::int64_t>(frame), .frame = frame};
}

}  // namespace laneloom::test
