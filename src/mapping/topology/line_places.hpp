#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <vector>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/box_grid.hpp"
#include "mapping/geometry/levels.hpp"

namespace laneloom::topology {

/// A place on one of several lines.
struct LinePlace {
  Point position = Point::Zero();
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< of the line
  std::size_t line = 0;                                  ///< its index
};

/// Places along lines, two metres apart, by which the lines are found that run past a point, at most
/// `reach_m` aside.
class LinePlaces {
 public:
  LinePlaces(const std::vector<const Polyline*>& lines, double reach_m)
      : reach_m_(reach_m), grid_(places_on(lines, reach_m), reach_m) {}

  /// Calls `visit(place, lateral_m)` for the places of lines that run past a point, on its level.
  template <class Visit>
  void beside(const Point& point, Visit&& visit) const {
    grid_.at(point, [&](const LinePlace& place) {
      const Eigen::Vector2d offset = (point - place.position).head<2>();
      if (std::abs(place.direction.dot(offset)) > kAlong_m) return;
      const double lateral_m = std::abs(cross(place.direction, offset));
      if (lateral_m <= reach_m_ && geometry::same_level(point, place.position)) visit(place, lateral_m);
    });
  }

 private:
  using Grid = geometry::BoxGrid<LinePlace>;

  static constexpr double kStep_m = 2.0;
  static constexpr double kAlong_m = 1.1;      // half a step and a little more
  static constexpr double kRounding_m = 1e-6;  // far above the errors of a box

  static std::vector<Grid::Boxed> places_on(const std::vector<const Polyline*>& lines, double reach_m) {
    std::vector<Grid::Boxed> places;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Polyline line = resample(*lines[i], kStep_m);
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        const LinePlace place{0.5 * (line[k] + line[k + 1]), (line[k + 1] - line[k]).head<2>().normalized(),
                              i};
        places.push_back({box_of(place, reach_m), place});
      }
    }
    return places;
  }

  /// The box around the points that a place lies beside.
  static Eigen::AlignedBox2d box_of(const LinePlace& place, double reach_m) {
    const Eigen::Vector2d along = place.direction.cwiseAbs();
    const Eigen::Vector2d reach = (kAlong_m * along + reach_m * along.reverse()).array() + kRounding_m;
    return {place.position.head<2>() - reach, place.position.head<2>() + reach};
  }

  double reach_m_;
  Grid grid_;
};

}  // namespace laneloom::topology
