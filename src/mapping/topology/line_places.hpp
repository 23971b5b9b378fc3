#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/geometry/point_grid.hpp"

namespace laneloom::topology {

/// A place on one of several lines.
struct LinePlace {
  Point position = Point::Zero();
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< of the line
  std::size_t line = 0;                                  ///< its index
};

/// Places along lines, a metre apart, by which the lines are found that run past a point.
class LinePlaces {
 public:
  /// Searches are quickest with the reach that is told here.
  LinePlaces(const std::vector<const Polyline*>& lines, double reach_m)
      : grid_(places_on(lines), 2.0 * reach_m) {}

  /// Calls `visit(place, lateral_m)` for the places of lines that run past a point, on its level, at most
  /// `reach_m` aside.
  template <class Visit>
  void beside(const Point& point, double reach_m, Visit&& visit) const {
    grid_.around(point, reach_m + kStep_m, [&](const LinePlace& place) {
      const Eigen::Vector2d offset = (point - place.position).head<2>();
      const double lateral_m = std::abs(cross(place.direction, offset));
      if (lateral_m > reach_m || std::abs(place.direction.dot(offset)) > kAlong_m) return;
      if (geometry::same_level(point, place.position)) visit(place, lateral_m);
    });
  }

 private:
  static constexpr double kStep_m = 1.0;
  static constexpr double kAlong_m = 0.6;  // half a step and a little more

  static std::vector<LinePlace> places_on(const std::vector<const Polyline*>& lines) {
    std::vector<LinePlace> places;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Polyline line = MeasuredPolyline(*lines[i]).resample(kStep_m);
      for (std::size_t k = 0; k + 1 < line.size(); ++k)
        places.push_back({0.5 * (line[k] + line[k + 1]), (line[k + 1] - line[k]).head<2>().normalized(), i});
    }
    return places;
  }

  geometry::PointGrid<LinePlace> grid_;
};

}  // namespace laneloom::topology
