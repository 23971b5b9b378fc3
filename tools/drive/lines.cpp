#include "drive/lines.hpp"

#include <algorithm>
#include <cmath>

#include "drive/steering.hpp"
#include "mapping/geometry/smooth_step.hpp"

namespace laneloom::drive {
namespace {

constexpr int kSmoothingPoints = 6;  // either way
constexpr double kEndReach_m = 3.0;
constexpr double kCurvatureReach_m = 6.0;
constexpr double kMaxCurvature_per_m = 0.2;
constexpr double kFade_m = 20.0;
constexpr double kMinBridge_m = 2.0;
constexpr double kBendStep_m = 0.5;
constexpr double kChangeOver_m = 30.0;

Point fitted(const Polyline& line, int at, int reach) {
  const double m = reach;
  const double scale = 3.0 / ((2.0 * m - 1.0) * (2.0 * m + 1.0) * (2.0 * m + 3.0));
  Point sum = Point::Zero();
  for (int i = -reach; i <= reach; ++i) {
    const double weight = scale * (3.0 * m * m + 3.0 * m - 1.0 - 5.0 * i * i);
    const int neighbour = at + i;
    sum += weight * line[static_cast<std::size_t>(neighbour)];
  }
  return sum;
}

}  // namespace

void append(Polyline& line, const Polyline& next) {
  if (next.empty()) return;
  if (line.empty()) {
    line = next;
    return;
  }
  const MeasuredPolyline measured(next);
  const Projection foot = measured.project(line.back());
  const double from_m = foot.inside ? foot.arc_m : 0.0;
  if (from_m >= measured.length()) return;
  for (const Point& point : measured.slice({from_m, measured.length()})) {
    if ((point - line.back()).head<2>().norm() > 0.1) line.push_back(point);
  }
}

Polyline smoothed(const Polyline& line) {
  Polyline out;
  out.reserve(line.size());
  const int last = static_cast<int>(line.size()) - 1;
  for (int i = 0; i <= last; ++i) out.push_back(fitted(line, i, std::min({i, last - i, kSmoothingPoints})));
  return out;
}

void prolong(Polyline& line, double by_m, double step_m) {
  const MeasuredPolyline measured(line);
  const double curvature =
      std::clamp(curvature_at(measured, measured.length() - kCurvatureReach_m, kCurvatureReach_m),
                 -kMaxCurvature_per_m, kMaxCurvature_per_m);
  const Eigen::Vector2d end = end_direction(line, End::back, kEndReach_m);
  double heading_rad = std::atan2(end.y(), end.x()) + 0.5 * kEndReach_m * curvature;
  for (double s_m = step_m; s_m <= by_m; s_m += step_m) {
    heading_rad += step_m * curvature * std::max(0.0, 1.0 - s_m / kFade_m);
    line.emplace_back(line.back() + step_m * Point(std::cos(heading_rad), std::sin(heading_rad), 0.0));
  }
}

Polyline bend_between(const Point& from, const Eigen::Vector2d& leaving, const Point& to,
                      const Eigen::Vector2d& entering) {
  const Point gap = to - from;
  const double gap_m = gap.head<2>().norm();
  const double turn_rad = std::atan2(cross(leaving, entering), leaving.dot(entering));
  // With this pull the cubic is near to an arc.
  const double pull_m = gap_m / std::pow(std::cos(0.25 * turn_rad), 2);
  const int steps = std::max(1, static_cast<int>(std::ceil(gap_m / kBendStep_m)));
  Polyline path;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;  // in Hermite's basis
    Point point = from + geometry::smooth_step(t) * gap;
    point.head<2>() += t * (1.0 - t) * pull_m * ((1.0 - t) * leaving - t * entering);
    path.push_back(point);
  }
  return path;
}

Polyline bridge(const Polyline& from, const Polyline& to) {
  const Eigen::Vector2d leaving = end_direction(from, End::back), entering = -end_direction(to, End::front);
  const Eigen::Vector2d gap = (to.front() - from.back()).head<2>();
  if (gap.norm() < kMinBridge_m || gap.dot(leaving) < 0.0) return {};
  return bend_between(from.back(), leaving, to.front(), entering);
}

Polyline change_over(const Polyline& line, const Polyline& other) {
  const MeasuredPolyline from(line), to(other);
  const double begin_m = std::max(0.0, from.length() - kChangeOver_m);
  Polyline out;
  for (const Point& point : from.resample(1.0)) {
    const double share = (from.project(point).arc_m - begin_m) / (from.length() - begin_m);
    out.emplace_back(point + geometry::smooth_step(share) * (to.project(point).foot - point));
  }
  append(out, other);
  return out;
}

}  // namespace laneloom::drive
