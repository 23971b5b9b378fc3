#include "drive/lines.hpp"

#include <algorithm>
#include <cmath>

#include "drive/steering.hpp"
#include "mapping/geometry/smooth_step.hpp"

namespace laneloom::drive {
namespace {

constexpr double kEndReach_m = 3.0;
constexpr double kCurvatureReach_m = 6.0;
constexpr double kMaxCurvature_per_m = 0.2;
constexpr double kFade_m = 20.0;
constexpr double kBendStep_m = 0.5;

}  // namespace

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

}  // namespace laneloom::drive
