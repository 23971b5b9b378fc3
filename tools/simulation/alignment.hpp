#pragma once

#include <utility>
#include <vector>

#include "laneloom/types.hpp"

/// The reference line of a street, and values that vary along it.
namespace laneloom::simulation {

/// A place in the map with a horizontal heading.
struct Frame {
  Point position = Point::Zero();
  double heading_rad = 0.0;

  Eigen::Vector2d direction() const;
  /// The unit direction to the left of the heading.
  Eigen::Vector2d normal() const;
  /// The frame, moved `left_m` to the left and `ahead_m` forwards.
  Frame moved(double left_m, double ahead_m = 0.0) const;
  Frame turned(double angle_deg) const;
};

/// A value along a street: constant before the first and after the last knot, without kinks between knots.
class Profile {
 public:
  Profile(double value = 0.0) : knots_{{0.0, value}} {}  // NOLINT(google-explicit-constructor)
  /// `knots` are (s, value), in ascending order of s.
  explicit Profile(std::vector<std::pair<double, double>> knots) : knots_(std::move(knots)) {}
  double at(double s_m) const;

 private:
  std::vector<std::pair<double, double>> knots_;
};

/// A piece of a reference line with constant curvature.
struct Segment {
  double length_m = 0.0;
  double turn_deg = 0.0;  ///< over the length, to the left
};
Segment straight(double length_m);
Segment bend(double radius_m, double turn_deg);

/// A reference line: straights and arcs from a frame on, with an elevation above that frame.
class Alignment {
 public:
  Alignment(const Frame& start, std::vector<Segment> segments, Profile elevation = {});
  double length() const { return length_m_; }
  Frame at(double s_m) const;
  Frame end() const { return at(length_m_); }
  /// The point beside the line at `s_m`; left is positive.
  Point point(double s_m, double left_m) const { return at(s_m).moved(left_m).position; }

 private:
  std::vector<Segment> segments_;
  std::vector<Frame> starts_;  // of each segment, without elevation
  Profile elevation_;
  double length_m_ = 0.0;
};

/// A smooth way from one frame to another: straight, then the widest arc that both headings allow; an
/// S-curve where they are parallel. Vertices every `step_m` or less on curves.
Polyline bridge(const Frame& from, const Frame& to, double step_m = 1.0);

}  // namespace laneloom::simulation
