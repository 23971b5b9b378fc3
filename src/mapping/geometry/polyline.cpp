#include "laneloom/polyline.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace laneloom {
namespace {

constexpr std::size_t kBlock = 8;  // segments in one bounding box

constexpr double kCoincident_m = 1e-9;

constexpr double kMargin_m = 1e-6;       // far above rounding errors, so that no equally near foot is skipped
constexpr double kMinAlongCourse = 0.2;  // cosine; a line that turns away further is searched by blocks

double horizontal_distance(const Point& a, const Point& b) { return (b - a).head<2>().norm(); }

/// A squared distance. A foot beyond it is further away than `distance_m`, whatever the rounding errors.
double squared_bound_m2(double distance_m) { return (distance_m + kMargin_m) * (distance_m + kMargin_m); }

}  // namespace

std::vector<double> arc_lengths(const Polyline& line) {
  std::vector<double> arc(line.size(), 0.0);
  for (std::size_t i = 1; i < line.size(); ++i)
    arc[i] = arc[i - 1] + horizontal_distance(line[i - 1], line[i]);
  return arc;
}

double length(const Polyline& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += horizontal_distance(line[i - 1], line[i]);
  return sum;
}

void drop_repeats(Polyline& line) {
  const auto repeats = [](const Point& a, const Point& b) {
    return horizontal_distance(a, b) <= kCoincident_m;
  };
  line.erase(std::unique(line.begin(), line.end(), repeats), line.end());
}

Polyline resample(const Polyline& line, double step_m) { return MeasuredPolyline(line).resample(step_m); }

MeasuredPolyline::MeasuredPolyline(const Polyline& points) {
  assert(!points.empty());
  points_.reserve(points.size());
  vertices_.reserve(points.size());
  points_.push_back(points.front());
  vertices_.emplace_back();
  for (const Point& point : points) {
    const double step_m = horizontal_distance(points_.back(), point);
    if (step_m <= kCoincident_m) continue;
    vertices_.push_back({.arc_m = length() + step_m});
    points_.push_back(point);
  }
  const Eigen::Vector2d chord = (points_.back() - points_.front()).head<2>();
  if (chord.norm() > kCoincident_m) course_ = chord.normalized();
  bounds_.extend(vertices_.front().in_course);
  for (std::size_t i = 1; i < points_.size(); ++i) {
    vertices_[i].in_course = in_course(points_[i]);
    bounds_.extend(vertices_[i].in_course);
    const double along_m = course_.dot((points_[i] - points_[i - 1]).head<2>());
    const double step_m = arc_m(i) - arc_m(i - 1);
    if (along_m < cosine_ * step_m) cosine_ = along_m / step_m;
  }
  cosine_ -= 1e-9;
  sine_ = std::sqrt(1.0 - cosine_ * cosine_);
  if (cosine_ <= kMinAlongCourse) bound_blocks();
}

void MeasuredPolyline::bound_blocks() {
  blocks_.resize((points_.size() - 1 + kBlock - 1) / kBlock);
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    Eigen::AlignedBox2d& block = blocks_[i / kBlock];
    block.extend(points_[i].head<2>()).extend(points_[i + 1].head<2>());
  }
}

/// The place of a point, seen from the first point: along the course, and to the left of it.
inline Eigen::Vector2d MeasuredPolyline::in_course(const Point& point) const {
  const Eigen::Vector2d offset = (point - points_.front()).head<2>();
  return {course_.dot(offset), cross(course_, offset)};
}

/// The point at an arc length, clamped to the line. `after` is the first vertex beyond the arc length.
inline Point MeasuredPolyline::at(double arc_m, std::size_t after) const {
  if (arc_m <= 0.0) return points_.front();
  if (arc_m >= length()) return points_.back();
  const double before_m = vertices_[after - 1].arc_m;
  const double share = (arc_m - before_m) / (vertices_[after].arc_m - before_m);
  return points_[after - 1] + share * (points_[after] - points_[after - 1]);
}

std::size_t MeasuredPolyline::first_beyond(double arc_m) const {
  const auto found = std::ranges::upper_bound(vertices_, arc_m, {}, &Vertex::arc_m);
  return static_cast<std::size_t>(found - vertices_.begin());
}

Point MeasuredPolyline::at(double arc_m) const { return at(arc_m, first_beyond(arc_m)); }

Eigen::Vector2d MeasuredPolyline::segment_direction(std::size_t end) const {
  return (points_[end] - points_[end - 1]).head<2>() / (arc_m(end) - arc_m(end - 1));
}

Eigen::Vector2d MeasuredPolyline::direction(double arc_m) const {
  if (points_.size() < 2) return Eigen::Vector2d::Zero();
  return segment_direction(std::clamp<std::size_t>(first_beyond(arc_m), 1, points_.size() - 1));
}

Eigen::Vector2d MeasuredPolyline::chord(double from_m, double to_m) const {
  return (at(to_m) - at(from_m)).head<2>().normalized();
}

Eigen::Vector2d MeasuredPolyline::direction(const Projection& foot) const {
  if (points_.size() < 2) return Eigen::Vector2d::Zero();
  std::size_t i = foot.segment + 1;
  while (i + 1 < points_.size() && arc_m(i) <= foot.arc_m) ++i;
  return segment_direction(i);
}

/// The nearest foot so far.
struct MeasuredPolyline::Nearest {
  double bound_m2 = 0.0;  ///< squared distance; a foot beyond it need not be considered
  double distance_m = std::numeric_limits<double>::infinity();
  std::size_t segment = kUnknown;
  double share = 0.0;  ///< of the segment; beyond 0..1 where the foot is at its end
};

inline void MeasuredPolyline::consider(std::size_t segment, const Point& point, Nearest& nearest) const {
  const Eigen::Vector2d start = points_[segment].head<2>();
  const Eigen::Vector2d along = points_[segment + 1].head<2>() - start;
  const double segment_m = arc_m(segment + 1) - arc_m(segment);
  const double share = (point.head<2>() - start).dot(along) / (segment_m * segment_m);
  const Eigen::Vector2d foot = start + std::clamp(share, 0.0, 1.0) * along;
  const double squared_m2 = (point.head<2>() - foot).squaredNorm();
  if (squared_m2 > nearest.bound_m2) return;
  const double distance_m = std::sqrt(squared_m2);
  if (distance_m > nearest.distance_m || (distance_m == nearest.distance_m && segment > nearest.segment))
    return;
  nearest = {squared_bound_m2(distance_m), distance_m, segment, share};
}

/// `place` is that of the point, in the course. Searches from there along the course to both sides; `segment`
/// is near that place, if it is known. From each vertex on, the line stays within a cone about the course.
/// Once that cone is further away than the nearest foot, so is the rest of the line.
inline void MeasuredPolyline::search_along_course(std::size_t segment, const Eigen::Vector2d& place,
                                                  const Point& point, Nearest& nearest) const {
  const auto ahead_m = [&](std::size_t vertex) { return place.x() - vertices_[vertex].in_course.x(); };
  const auto is_past = [&](std::size_t vertex, double sense) {
    const Eigen::Vector2d offset = place - vertices_[vertex].in_course;
    const double along_m = sense * offset.x(), aside_m = std::abs(offset.y());
    const double along_edge_m = along_m * cosine_ + aside_m * sine_;
    if (along_edge_m <= 0.0) return offset.squaredNorm() > nearest.bound_m2;
    const double from_edge_m = aside_m * cosine_ - along_m * sine_;
    return from_edge_m > 0.0 && from_edge_m * from_edge_m > nearest.bound_m2;
  };
  const std::size_t last = points_.size() - 2;
  std::size_t middle = segment;
  if (segment == kUnknown) {
    // Vertices mostly are evenly spaced.
    const double guess = place.x() / bounds_.sizes().x() * static_cast<double>(last);
    middle = static_cast<std::size_t>(std::clamp(guess, 0.0, static_cast<double>(last)));
  }
  while (middle < last && ahead_m(middle + 1) >= 0.0) ++middle;
  while (middle > 0 && ahead_m(middle) < 0.0) --middle;
  consider(middle, point, nearest);
  for (std::size_t i = middle + 1; i <= last && !is_past(i, 1.0); ++i) consider(i, point, nearest);
  for (std::size_t i = middle; i > 0 && !is_past(i, -1.0); --i) consider(i - 1, point, nearest);
}

void MeasuredPolyline::consider_block(std::size_t block, const Point& point, Nearest& nearest) const {
  const std::size_t end = std::min((block + 1) * kBlock, points_.size() - 1);
  for (std::size_t i = block * kBlock; i < end; ++i) consider(i, point, nearest);
}

/// The block that is nearest to a place.
std::size_t MeasuredPolyline::nearest_block(const Eigen::Vector2d& place) const {
  const auto distance_m2 = [&](const Eigen::AlignedBox2d& block) {
    return block.squaredExteriorDistance(place);
  };
  return static_cast<std::size_t>(std::ranges::min_element(blocks_, {}, distance_m2) - blocks_.begin());
}

/// Searches first the block that holds `segment`, or the nearest one. It mostly holds the foot, and few other
/// blocks are as near as that foot.
void MeasuredPolyline::search_blocks(std::size_t segment, const Point& point, Nearest& nearest) const {
  const Eigen::Vector2d place = point.head<2>();
  const std::size_t first = segment == kUnknown ? nearest_block(place) : segment / kBlock;
  consider_block(first, point, nearest);
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (k != first && blocks_[k].squaredExteriorDistance(place) <= nearest.bound_m2)
      consider_block(k, point, nearest);
  }
}

Projection MeasuredPolyline::project(const Point& point, double within_m) const {
  return project_from(kUnknown, point, within_m);
}

Projection MeasuredPolyline::project_from(std::size_t segment, const Point& point, double within_m) const {
  Projection result;
  result.distance_m = std::numeric_limits<double>::infinity();
  Nearest nearest{.bound_m2 = squared_bound_m2(within_m)};
  const Eigen::Vector2d place = in_course(point);
  if (bounds_.squaredExteriorDistance(place) > nearest.bound_m2) return result;
  if (points_.size() == 1) {
    result.foot = points_.front();
    result.distance_m = horizontal_distance(point, result.foot);
    return result;
  }
  cosine_ > kMinAlongCourse ? search_along_course(segment, place, point, nearest)
                            : search_blocks(segment, point, nearest);
  if (nearest.distance_m > within_m) return result;
  const auto& [bound, distance_m, i, share] = nearest;
  const double clamped = std::clamp(share, 0.0, 1.0);
  const double segment_m = arc_m(i + 1) - arc_m(i);
  const bool before_start = i == 0 && share < 0.0;
  const bool after_end = i + 2 == points_.size() && share > 1.0;
  const double side =
      cross((points_[i + 1] - points_[i]).head<2>(), (point - points_[i]).head<2>()) / segment_m;
  return {.arc_m = arc_m(i) + clamped * segment_m,
          .distance_m = distance_m,
          .lateral_m = before_start || after_end ? side : std::copysign(distance_m, side),
          .inside = !before_start && !after_end,
          .segment = i,
          .foot = points_[i] + clamped * (points_[i + 1] - points_[i])};
}

Polyline MeasuredPolyline::slice(const Stretch& range) const {
  Polyline out;
  out.reserve(points_.size() + 2);
  out.push_back(at(range.from_m));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (arc_m(i) > range.from_m + kCoincident_m && arc_m(i) < range.to_m - kCoincident_m)
      out.push_back(points_[i]);
  }
  out.push_back(at(range.to_m));
  return out;
}

Polyline MeasuredPolyline::resample(double step_m) const {
  const auto steps = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length() / step_m)));
  Polyline out;
  out.reserve(steps + 1);
  std::size_t after = 0;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double arc_m = length() * static_cast<double>(i) / static_cast<double>(steps);
    while (after < vertices_.size() && vertices_[after].arc_m <= arc_m) ++after;
    out.push_back(at(arc_m, after));
  }
  return out;
}

Point MeasuredPolyline::Cursor::at(double arc_m) {
  while (after_ < line_.vertices_.size() && line_.arc_m(after_) <= arc_m) ++after_;
  while (after_ > 0 && line_.arc_m(after_ - 1) > arc_m) --after_;
  return line_.at(arc_m, after_);
}

Projection MeasuredPolyline::Cursor::project(const Point& point, double within_m) {
  Projection foot = line_.project_from(segment_, point, within_m);
  if (foot.distance_m <= within_m) segment_ = foot.segment;
  return foot;
}

Eigen::Vector2d end_direction(const Polyline& line, End end, double reach_m) {
  const std::size_t last = line.size() - 1;
  const auto vertex = [&](std::size_t k) -> const Point& { return line[end == End::back ? last - k : k]; };
  double reached_m = 0.0;
  std::size_t k = 0;
  while (k < last && reached_m < reach_m) {
    reached_m += horizontal_distance(vertex(k), vertex(k + 1));
    ++k;
  }
  const Eigen::Vector2d outward = (vertex(0) - vertex(k)).head<2>();
  const double norm = outward.norm();
  if (norm < kCoincident_m) return Eigen::Vector2d::Zero();
  return outward / norm;
}

double cos_degrees(double angle_deg) {
  // Folded into [0, 90] degrees, then the Taylor series to below the last bit.
  double folded = std::abs(angle_deg);
  if (folded > 180.0) folded = std::abs(folded - 360.0);
  const bool obtuse = folded > 90.0;
  if (obtuse) folded = 180.0 - folded;
  const double x = folded * (std::numbers::pi / 180.0);
  double term = 1.0, sum = 1.0;
  for (int k = 2; k <= 26; k += 2) {
    term *= -x * x / (k * (k - 1));
    sum += term;
  }
  return obtuse ? -sum : sum;
}

namespace {

bool segments_intersect(const Point& a, const Point& b, const Point& c, const Point& d, double max_height_m) {
  const Eigen::Vector2d ab = (b - a).head<2>(), cd = (d - c).head<2>(), ac = (c - a).head<2>();
  const double sine = cross(ab, cd);
  if (sine == 0.0) return false;
  const double along_ab = cross(ac, cd) / sine, along_cd = cross(ac, ab) / sine;
  if (along_ab < 0.0 || along_ab > 1.0 || along_cd < 0.0 || along_cd > 1.0) return false;
  const double over_m = a.z() + along_ab * (b - a).z() - (c.z() + along_cd * (d - c).z());
  return std::abs(over_m) <= max_height_m;
}

}  // namespace

bool intersect(const Polyline& a, const Polyline& b, double max_height_m) {
  Eigen::AlignedBox2d all_of_b;
  for (const Point& point : b) all_of_b.extend(point.head<2>());
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    const Eigen::AlignedBox2d segment =
        Eigen::AlignedBox2d(a[i].head<2>(), a[i].head<2>()).extend(a[i + 1].head<2>());
    if (!segment.intersects(all_of_b)) continue;
    for (std::size_t j = 0; j + 1 < b.size(); ++j)
      if (segments_intersect(a[i], a[i + 1], b[j], b[j + 1], max_height_m)) return true;
  }
  return false;
}

}  // namespace laneloom
