#pragma once

#include <pugixml.hpp>
#include <string>
#include <vector>

#include "laneloom/types.hpp"
#include "simulation/alignment.hpp"
#include "simulation/lanelet2_ways.hpp"

/// The numbers and the reference line of a road of OpenDRIVE. What is wrong is a BadElement of the `road`.
namespace laneloom::simulation {

/// An attribute of an element within a road. It must be a finite number within 10 000 km.
double number(const pugi::xml_node& road, const pugi::xml_node& element, const char* name);
/// Likewise, or `otherwise` if there is no such attribute.
double number_or(const pugi::xml_node& road, const pugi::xml_node& element, const char* name,
                 double otherwise);

/// A cubic of OpenDRIVE: a + b d + c d² + d d³, from `start` on.
struct Cubic {
  double start_m = 0.0;
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
  double at(double distance_m) const { return a + distance_m * (b + distance_m * (c + distance_m * d)); }
  double slope(double distance_m) const { return b + distance_m * (2.0 * c + distance_m * 3.0 * d); }
};

/// Cubics one after the other, such as an elevation or the width of a lane.
class Cubics {
 public:
  /// The children of this name. `start` names the attribute with their begin.
  Cubics(const pugi::xml_node& road, const pugi::xml_node& parent, const char* name, const char* start);
  Cubics() = default;

  bool empty() const { return cubics_.empty(); }
  /// The value of the last cubic that begins at or before a place; 0 if there is none.
  double at(double place_m) const;

 private:
  std::vector<Cubic> cubics_;  ///< starts ascend
};

/// A piece of a reference line: line, arc, spiral, poly3 or paramPoly3.
class Geometry {
 public:
  Geometry(const pugi::xml_node& road, const pugi::xml_node& element);

  double start_m() const { return start_m_; }
  double length_m() const { return length_m_; }
  /// The frame at a distance from its start, without height.
  Frame at(double distance_m) const;

 private:
  /// The way along a curve is summed up in steps.
  struct Step {
    double along = 0.0;  ///< parameter of the curve there
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
  };
  enum class Kind { arc, spiral, poly3, param_poly3 };

  Frame local(double distance_m) const;
  Frame along_spiral(double distance_m) const;
  double spiral_heading(double distance_m) const;

  Kind kind_ = Kind::arc;
  double start_m_, length_m_;
  Frame start_;
  double curvature_ = 0.0, curvature_rate_ = 0.0;  ///< 1/m, 1/m²
  Cubic u_, v_;                                    ///< of poly3 and paramPoly3, u forwards and v to the left
  double end_parameter_ = 1.0;                     ///< of paramPoly3
  std::vector<Step> steps_;                        ///< of a spiral and of poly3, a metre each
};

/// The reference line of a road, with its elevation.
class ReferenceLine {
 public:
  explicit ReferenceLine(const pugi::xml_node& road);

  double length_m() const { return length_m_; }
  /// The point beside the line at `s_m`; left is positive.
  Point point(double s_m, double left_m) const;
  Frame at(double s_m) const;

 private:
  std::vector<Geometry> geometries_;
  Cubics elevation_;
  double length_m_ = 0.0;
};

}  // namespace laneloom::simulation
