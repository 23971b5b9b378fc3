#include "simulation/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/degree.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/geometry/smooth_step.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kParallel_rad = 0.01;

Frame advance(const Frame& start, const Segment& segment, double along_m) {
  const double turn_rad = segment.turn_deg * kDegree * along_m / segment.length_m;
  if (std::abs(turn_rad) < 1e-12) return start.moved(0.0, along_m);
  const double radius_m = along_m / turn_rad;
  Frame frame = start.moved(radius_m * (1.0 - std::cos(turn_rad)), radius_m * std::sin(turn_rad));
  frame.heading_rad += turn_rad;
  return frame;
}

Polyline s_curve(const Frame& from, const Frame& to, double step_m) {
  const double distance_m = (to.position - from.position).head<2>().norm();
  const double left_m = from.normal().dot((to.position - from.position).head<2>());
  const double ahead_m = from.direction().dot((to.position - from.position).head<2>());
  const int steps = std::max(1, static_cast<int>(std::ceil(distance_m / step_m)));
  Polyline out;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    Point point = from.moved(left_m * geometry::smooth_step(share), ahead_m * share).position;
    point.z() = std::lerp(from.position.z(), to.position.z(), share);
    out.push_back(point);
  }
  return out;
}

}  // namespace

Eigen::Vector2d Frame::direction() const { return {std::cos(heading_rad), std::sin(heading_rad)}; }
Eigen::Vector2d Frame::normal() const { return {-std::sin(heading_rad), std::cos(heading_rad)}; }

Frame Frame::moved(double left_m, double ahead_m) const {
  Frame frame = *this;
  frame.position.head<2>() += left_m * normal() + ahead_m * direction();
  return frame;
}

Frame Frame::turned(double angle_deg) const { return {position, heading_rad + angle_deg * kDegree}; }

double Profile::at(double s_m) const {
  if (s_m <= knots_.front().first) return knots_.front().second;
  for (std::size_t i = 1; i < knots_.size(); ++i) {
    const auto& [to_m, to] = knots_[i];
    const auto& [from_m, from] = knots_[i - 1];
    if (s_m < to_m) return std::lerp(from, to, geometry::smooth_step((s_m - from_m) / (to_m - from_m)));
  }
  return knots_.back().second;
}

Segment straight(double length_m) { return {length_m, 0.0}; }
Segment bend(double radius_m, double turn_deg) { return {radius_m * std::abs(turn_deg) * kDegree, turn_deg}; }

Alignment::Alignment(const Frame& start, std::vector<Segment> segments, Profile elevation)
    : segments_(std::move(segments)), elevation_(std::move(elevation)) {
  Frame frame = start;
  for (const Segment& segment : segments_) {
    starts_.push_back(frame);
    frame = advance(frame, segment, segment.length_m);
    length_m_ += segment.length_m;
  }
}

Frame Alignment::at(double s_m) const {
  std::size_t i = 0;
  double along_m = std::clamp(s_m, 0.0, length_m_);
  while (i + 1 < segments_.size() && along_m > segments_[i].length_m) along_m -= segments_[i++].length_m;
  Frame frame = advance(starts_[i], segments_[i], along_m);
  frame.position.z() += elevation_.at(s_m);
  return frame;
}

Polyline bridge(const Frame& from, const Frame& to, double step_m) {
  const double turn_rad = std::remainder(to.heading_rad - from.heading_rad, 2.0 * std::numbers::pi);
  if (std::abs(turn_rad) < kParallel_rad) return s_curve(from, to, step_m);
  // Distances to the point where the line ahead of `from` meets the line behind `to`.
  const Eigen::Vector2d between = (to.position - from.position).head<2>();
  const double ahead_m = cross(between, to.direction()) / cross(from.direction(), to.direction());
  const double behind_m = cross(from.direction(), between) / cross(from.direction(), to.direction());
  const double tangent_m = std::min(ahead_m, behind_m);
  const double radius_m = tangent_m / std::tan(std::abs(turn_rad) / 2.0);
  const Alignment way(from, {straight(ahead_m - tangent_m + 1e-9), bend(radius_m, turn_rad / kDegree),
                             straight(behind_m - tangent_m + 1e-9)});
  const int steps = std::max(1, static_cast<int>(std::ceil(way.length() / step_m)));
  Polyline out;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    out.push_back(way.point(share * way.length(), 0.0));
    out.back().z() = std::lerp(from.position.z(), to.position.z(), share);
  }
  out.front() = from.position;
  out.back() = to.position;
  return out;
}

}  // namespace laneloom::simulation
