#include "drive/steering.hpp"

#include <algorithm>
#include <cmath>

namespace laneloom::drive {
namespace {

constexpr double kPreview_s = 0.25;  // time that turning the wheels takes
constexpr double kReach_s = 0.8;     // time over which offsets are taken away
constexpr double kMinReach_m = 4.0;
constexpr double kTangentReach_m = 1.0;
constexpr double kDamping = 1.0;
constexpr double kMaxLateral_mps2 = 2.0;
constexpr double kComfortableBraking_mps2 = 1.5;
constexpr double kStep_m = 1.0;

/// The direction of a path, without the steps between a polyline's segments.
Eigen::Vector2d direction_at(const MeasuredPolyline& path, double arc_m) {
  const Eigen::Vector2d chord =
      (path.at(arc_m + kTangentReach_m) - path.at(arc_m - kTangentReach_m)).head<2>();
  return chord.normalized();
}

double safe_speed(const MeasuredPolyline& path, double from_m, double speed_mps) {
  double fastest_mps = speed_mps;
  const double stopping_m = speed_mps * speed_mps / (2.0 * kComfortableBraking_mps2);
  for (double ahead_m = 0.0; ahead_m < stopping_m; ahead_m += kStep_m) {
    if (from_m + ahead_m > path.length()) break;
    const double curvature = std::abs(curvature_at(path, from_m + ahead_m));
    const double there = kMaxLateral_mps2 / std::max(curvature, 1e-6);  // squared speed there
    fastest_mps = std::min(fastest_mps, std::sqrt(there + 2.0 * kComfortableBraking_mps2 * ahead_m));
  }
  return fastest_mps;
}

}  // namespace

double curvature_at(const MeasuredPolyline& path, double arc_m, double max_reach_m) {
  const double reach_m = std::min(max_reach_m, 0.5 * path.length());
  const double at_m = std::clamp(arc_m, reach_m, path.length() - reach_m);
  const Eigen::Vector2d middle = path.at(at_m).head<2>();
  const Eigen::Vector2d in = middle - path.at(at_m - reach_m).head<2>();
  const Eigen::Vector2d out = path.at(at_m + reach_m).head<2>() - middle;
  return std::atan2(cross(in, out), in.dot(out)) / reach_m;
}

Command follow(const MeasuredPolyline& path, const Bicycle& vehicle, double speed_mps) {
  const Projection foot = path.project(on_ground(vehicle.rear_axle));
  const Eigen::Vector2d along = direction_at(path, foot.arc_m);
  const double sine = cross(along, vehicle.direction());
  const double reach_m = std::max(kMinReach_m, kReach_s * vehicle.speed_mps);
  const double offset_m = std::clamp(foot.lateral_m, -reach_m, reach_m);
  const double curvature = curvature_at(path, foot.arc_m + kPreview_s * vehicle.speed_mps) -
                           2.0 * kDamping * sine / reach_m - offset_m / (reach_m * reach_m);
  return {std::atan(kWheelbase_m * curvature), safe_speed(path, foot.arc_m, speed_mps)};
}

}  // namespace laneloom::drive
