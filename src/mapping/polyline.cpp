#include "laneloom/polyline.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace laneloom {
namespace {

constexpr std::size_t kStride = 8;  // between the vertices that are looked at first

constexpr double kCoincident_m = 1e-9;

double horizontal_distance(const Point& a, const Point& b) { return (b - a).head<2>().norm(); }

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

MeasuredPolyline::MeasuredPolyline(const Polyline& points) {
  assert(!points.empty());
  points_.reserve(points.size());
  for (const Point& point : points) {
    if (points_.empty() || horizontal_distance(points_.back(), point) > kCoincident_m)
      points_.push_back(point);
  }
  arc_ = arc_lengths(points_);
}

Point MeasuredPolyline::at(double arc_m) const {
  if (arc_m <= 0.0) return points_.front();
  if (arc_m >= length()) return points_.back();
  const auto after = std::upper_bound(arc_.begin(), arc_.end(), arc_m);
  const auto i = static_cast<std::size_t>(after - arc_.begin());
  const double share = (arc_m - arc_[i - 1]) / (arc_[i] - arc_[i - 1]);
  return points_[i - 1] + share * (points_[i] - points_[i - 1]);
}

Eigen::Vector2d MeasuredPolyline::direction(double arc_m) const {
  if (points_.size() < 2) return Eigen::Vector2d::Zero();
  const auto after = std::upper_bound(arc_.begin(), arc_.end(), arc_m);
  const auto i =
      std::clamp<std::size_t>(static_cast<std::size_t>(after - arc_.begin()), 1, points_.size() - 1);
  return (points_[i] - points_[i - 1]).head<2>() / (arc_[i] - arc_[i - 1]);
}

Projection MeasuredPolyline::project(const Point& point) const {
  Projection best;
  best.distance_m = std::numeric_limits<double>::infinity();
  if (points_.size() == 1) {
    best.foot = points_.front();
    best.distance_m = horizontal_distance(point, best.foot);
    return best;
  }
  // Along the line, the distance changes no faster than the arc length: what must be farther than a few of
  // the vertices is passed over.
  double bound_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points_.size(); i += kStride)
    bound_m = std::min(bound_m, (point - points_[i]).head<2>().squaredNorm());
  bound_m = std::sqrt(bound_m);
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const double slack_m = horizontal_distance(point, points_[i]) - bound_m;
    const double from_m = arc_[i];
    while (i + 1 < points_.size() && arc_[i + 1] - from_m < slack_m) ++i;
    if (i + 1 == points_.size()) break;
    const Eigen::Vector2d along = (points_[i + 1] - points_[i]).head<2>();
    const double segment_m = arc_[i + 1] - arc_[i];
    const Eigen::Vector2d offset = (point - points_[i]).head<2>();
    const double share = offset.dot(along) / (segment_m * segment_m);
    const double clamped = std::clamp(share, 0.0, 1.0);
    const Point foot = points_[i] + clamped * (points_[i + 1] - points_[i]);
    const double distance_m = horizontal_distance(point, foot);
    if (distance_m >= best.distance_m) continue;
    const bool before_start = i == 0 && share < 0.0;
    const bool after_end = i + 2 == points_.size() && share > 1.0;
    const double side = cross(along, offset) / segment_m;
    best = {.arc_m = arc_[i] + clamped * segment_m,
            .distance_m = distance_m,
            .lateral_m = before_start || after_end ? side : std::copysign(distance_m, side),
            .inside = !before_start && !after_end,
            .segment = i,
            .foot = foot};
  }
  return best;
}

Polyline MeasuredPolyline::slice(const Range& range) const {
  Polyline out{at(range.from_m)};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (arc_[i] > range.from_m + kCoincident_m && arc_[i] < range.to_m - kCoincident_m)
      out.push_back(points_[i]);
  }
  out.push_back(at(range.to_m));
  return out;
}

Polyline MeasuredPolyline::resample(double step_m) const {
  const auto steps = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length() / step_m)));
  Polyline out;
  out.reserve(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i) {
    out.push_back(at(length() * static_cast<double>(i) / static_cast<double>(steps)));
  }
  return out;
}

Eigen::Vector2d end_direction(const Polyline& line, bool at_back, double reach_m) {
  const std::size_t last = line.size() - 1;
  const auto vertex = [&](std::size_t k) -> const Point& { return line[at_back ? last - k : k]; };
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

bool segments_intersect(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Eigen::Vector2d ab = (b - a).head<2>(), cd = (d - c).head<2>(), ac = (c - a).head<2>();
  const double sine = cross(ab, cd);
  if (sine == 0.0) return false;
  const double along_ab = cross(ac, cd) / sine, along_cd = cross(ac, ab) / sine;
  return along_ab >= 0.0 && along_ab <= 1.0 && along_cd >= 0.0 && along_cd <= 1.0;
}

}  // namespace

bool intersect(const Polyline& a, const Polyline& b) {
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    for (std::size_t j = 0; j + 1 < b.size(); ++j)
      if (segments_intersect(a[i], a[i + 1], b[j], b[j + 1])) return true;
  return false;
}

}  // namespace laneloom
