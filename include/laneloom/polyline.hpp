#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <vector>

#include "laneloom/types.hpp"

/// Geometry of polylines. Distances and angles are horizontal (roads are surfaces): z is carried along and
/// never decides. Pure functions; a polyline has at least one point unless said otherwise.
namespace laneloom {

/// Arc length at every vertex, horizontal, in metres; starts with 0. Empty for an empty polyline.
std::vector<double> arc_lengths(const Polyline& line);

/// Horizontal length, in metres. 0 for an empty polyline.
double length(const Polyline& line);

/// Leaves out the vertices that repeat their predecessor (horizontally).
void drop_repeats(Polyline& line);

/// Points every `step_m` (slightly less, so that both ends are met), at least two.
Polyline resample(const Polyline& line, double step_m);

/// The foot of a point on a polyline.
struct Projection {
  double arc_m = 0.0;       ///< arc length of the foot
  double distance_m = 0.0;  ///< horizontal, from the point to the foot
  /// Signed distance; left of the line is positive. Beyond an end it is measured from the line's extension.
  double lateral_m = 0.0;
  bool inside = false;         ///< the foot is on the line, not beyond one of its ends
  std::size_t segment = 0;     ///< the segment that holds the foot; segment i joins points i and i + 1
  Point foot = Point::Zero();  ///< in the frame of the polyline
};

/// A polyline with its arc lengths, for repeated queries. Keeps a copy of the points.
class MeasuredPolyline {
 public:
  MeasuredPolyline() = default;
  /// `points` are one or more. Vertices that repeat their predecessor (horizontally) are left out.
  explicit MeasuredPolyline(const Polyline& points);
  // Eigen's boxes do not say that their moves never throw: a vector that grows would copy the lines.
  MeasuredPolyline(MeasuredPolyline&&) noexcept = default;
  MeasuredPolyline& operator=(MeasuredPolyline&&) noexcept = default;
  MeasuredPolyline(const MeasuredPolyline&) = default;
  MeasuredPolyline& operator=(const MeasuredPolyline&) = default;
  ~MeasuredPolyline() = default;

  /// The points without those that were left out.
  const Polyline& points() const { return points_; }
  /// The arc length of a point, horizontal, in metres.
  double arc_m(std::size_t point) const { return vertices_[point].arc_m; }
  /// The index of the first point beyond an arc length; the number of points where there is none.
  std::size_t first_beyond(double arc_m) const;
  /// Horizontal length, in metres.
  double length() const { return vertices_.empty() ? 0.0 : vertices_.back().arc_m; }
  /// The point at an arc length, clamped to the line.
  Point at(double arc_m) const;
  /// Horizontal unit direction of the segment that holds an arc length; zero for a single point.
  Eigen::Vector2d direction(double arc_m) const;
  /// The horizontal unit direction at a foot on this line. Needs no search.
  Eigen::Vector2d direction(const Projection& foot) const;
  /// Horizontal unit direction from the point at one arc length to that at another, both clamped to the line;
  /// zero where they are one point.
  Eigen::Vector2d chord(double from_m, double to_m) const;
  /// The nearest foot of `point`; the first one where several are equally near. Where no foot is as near as
  /// `within_m`, the result has an infinite `distance_m` and is not `inside`.
  Projection project(const Point& point, double within_m = std::numeric_limits<double>::infinity()) const;
  /// The stretch between two arc lengths (from < to, both clamped), with its inner vertices.
  Polyline slice(const Stretch& range) const;
  /// Points every `step_m` (slightly less, so that both ends are met), at least two.
  Polyline resample(double step_m) const;

  class Cursor;

 private:
  static constexpr std::size_t kUnknown = std::numeric_limits<std::size_t>::max();
  struct Nearest;
  /// A point, as queries look at it.
  struct Vertex {
    double arc_m = 0.0;
    Eigen::Vector2d in_course = Eigen::Vector2d::Zero();  ///< the point, in the frame of the course
  };
  Point at(double arc_m, std::size_t after) const;
  void bound_blocks();
  void consider(std::size_t segment, const Point& point, Nearest& nearest) const;
  void consider_block(std::size_t block, const Point& point, Nearest& nearest) const;
  Projection project_from(std::size_t segment, const Point& point, double within_m) const;
  void search_along_course(std::size_t segment, const Eigen::Vector2d& place, const Point& point,
                           Nearest& nearest) const;
  std::size_t nearest_block(const Eigen::Vector2d& place) const;
  void search_blocks(std::size_t segment, const Point& point, Nearest& nearest) const;
  Eigen::Vector2d segment_direction(std::size_t end) const;
  Eigen::Vector2d in_course(const Point& point) const;

  Polyline points_;
  std::vector<Vertex> vertices_;  ///< one for each point
  // The search for a foot is narrowed by these. Their frame is the first point and the course.
  Eigen::Vector2d course_ = Eigen::Vector2d::UnitX();  ///< from the first point to the last
  Eigen::AlignedBox2d bounds_;                         ///< along the course, and to the left of it
  double cosine_ = 1.0, sine_ = 0.0;         ///< of the largest angle between a segment and the course
  std::vector<Eigen::AlignedBox2d> blocks_;  ///< bounds of a few segments each, where the line turns far
};

/// Answers queries in a row about a polyline. Each search begins at the place that was asked about before, so
/// neighbouring places are found at once. The answers are the polyline's own. It refers to the polyline.
class MeasuredPolyline::Cursor {
 public:
  explicit Cursor(const MeasuredPolyline& line) : line_(line) {}

  Point at(double arc_m);
  Projection project(const Point& point, double within_m = std::numeric_limits<double>::infinity());

 private:
  const MeasuredPolyline& line_;
  std::size_t after_ = 0;           ///< the first vertex beyond the arc length before
  std::size_t segment_ = kUnknown;  ///< that held the foot before
};

/// The point at one end of a polyline, which must not be empty.
inline const Point& end_point(const Polyline& line, End end) {
  return end == End::back ? line.back() : line.front();
}

/// Horizontal direction in which `line` is left at one of its ends, over its last `reach_m`. Unit length;
/// zero for a line without horizontal extent.
Eigen::Vector2d end_direction(const Polyline& line, End end, double reach_m = 3.0);

/// Whether two polylines have a point in common, seen from above, at most `max_height_m` over one another.
/// Stretches that run within one another in parallel do not count.
bool intersect(const Polyline& a, const Polyline& b, double max_height_m);

/// z component of the cross product: positive where b is left of a.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Cosine of an angle in degrees within [-360, 360], the same to the last bit on every host (libm's is not).
double cos_degrees(double angle_deg);

}  // namespace laneloom
