#pragma once

#include <cstddef>
#include <vector>

#include "mapping/lanes/way_route.hpp"

/// From a route to a smooth line.
namespace laneloom::lanes {

/// A place of a route.
struct RoutePlace {
  Point point = Point::Zero();
  std::size_t piece = 0;
  double arc_m = 0.0;   ///< along the piece's lane
  double weight = 1.0;  ///< near a joint that has a step it is less
};

/// Distance between the places of a route, in metres.
inline constexpr double kSample_m = 1.0;

/// Places every `kSample_m` along a route.
std::vector<RoutePlace> sampled(const Route& route);

/// A smooth line, and where on the route it is.
class WayLine {
 public:
  /// `places` are two or more.
  explicit WayLine(std::vector<RoutePlace> places);

  /// Arc length of the last point.
  double length() const { return arcs_m_.back(); }
  /// Arc length of the first bend after `from_m` that is tighter than any vehicle drives; length(): there is
  /// none.
  double drivable_to(double from_m) const;
  /// Arc length of the foot of a point; beyond an end it is less than 0, or more than the length.
  double foot(const Point& point) const;

  struct Sample {
    Point point = Point::Zero();
    Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< horizontal, of unit length
    double curvature_per_m = 0.0;
    RoutePlace place;  ///< of the route, beside the point
  };
  Sample at(double arc_m) const;

 private:
  struct Between {
    std::size_t i;
    double share;
  };
  Between find(double arc_m) const;
  void measure();
  double sharpest_near(std::size_t i) const;

  std::vector<RoutePlace> places_;
  Polyline points_;
  std::vector<double> arcs_m_;
  std::vector<Eigen::Vector2d> directions_;
  std::vector<double> curvatures_per_m_;
};

}  // namespace laneloom::lanes
