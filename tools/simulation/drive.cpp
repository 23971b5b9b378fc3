#include "simulation/drive.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kPoseStep_m = 0.25;
constexpr int kSmoothingSteps = 8;  // either way: 2 m
constexpr double kClosed_m = 0.01;
constexpr double kClosed_rad = 0.01;

double seconds(std::int64_t stamp_ns) { return static_cast<double>(stamp_ns) * 1e-9; }
std::int64_t nearest_ns(double t_s) { return static_cast<std::int64_t>(std::llround(t_s * 1e9)); }

bool returns_to_start(const Polyline& path) { return (path.front() - path.back()).norm() < kClosed_m; }

// Replaces points by the mean over the neighbours either way. On a ring the window goes round; otherwise it
// shrinks to nothing at an end.
Polyline moving_average(const Polyline& path, bool ring) {
  const int last = static_cast<int>(path.size()) - 1;  // on a ring, it is the first point again
  const int reach = std::min(kSmoothingSteps, last / 2);
  Polyline out(path.size());
  for (int i = 0; i <= last; ++i) {
    const int window = ring ? reach : std::min({reach, i, last - i});
    Point sum = Point::Zero();
    for (int k = -window; k <= window; ++k) {
      const int at = ring ? (i + k + last) % last : i + k;
      sum += path[static_cast<std::size_t>(at)];
    }
    out[static_cast<std::size_t>(i)] = sum / (2 * window + 1);
  }
  return out;
}

Eigen::Quaterniond heading_along(const Point& tangent) {
  const double yaw_rad = std::atan2(tangent.y(), tangent.x());
  const double pitch_rad = -std::atan2(tangent.z(), tangent.head<2>().norm());
  return Eigen::AngleAxisd(yaw_rad, Point::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Point::UnitY());
}

}  // namespace

Drive Drive::along(const Polyline& path, double speed_mps) {
  if (path.size() < 2 || !(length(path) > kPoseStep_m))
    throw std::invalid_argument("a drive needs a path with a length");
  if (!(speed_mps > 0.0)) throw std::invalid_argument("a drive needs a positive speed");
  const bool ring = returns_to_start(path);
  Polyline points = MeasuredPolyline(path).resample(kPoseStep_m);
  for (int pass = 0; pass < 2; ++pass) points = moving_average(points, ring);

  Drive drive;
  const std::size_t last = points.size() - 1;
  double travelled_m = 0.0;
  for (std::size_t i = 0; i <= last; ++i) {
    if (i > 0) travelled_m += (points[i] - points[i - 1]).norm();
    const Point& before = i > 0 ? points[i - 1] : points[ring ? last - 1 : 0];
    const Point& after = i < last ? points[i + 1] : points[ring ? 1 : last];
    drive.poses_.push_back({.stamp_ns = nearest_ns(travelled_m / speed_mps),
                            .position = points[i],
                            .orientation = heading_along(after - before)});
  }
  return drive;
}

Drive Drive::recorded(std::vector<VehiclePose> poses) {
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (poses[i].stamp_ns <= poses[i - 1].stamp_ns)
      throw std::invalid_argument("the stamps of a recorded drive must ascend");
  }
  const std::int64_t start_ns = poses.empty() ? 0 : poses.front().stamp_ns;
  for (VehiclePose& pose : poses) pose.stamp_ns -= start_ns;
  Drive drive;
  drive.poses_ = std::move(poses);
  return drive;
}

double Drive::duration_s() const { return poses_.empty() ? 0.0 : seconds(poses_.back().stamp_ns); }

bool Drive::closed() const {
  if (poses_.size() < 3) return false;
  const VehiclePose &first = poses_.front(), &last = poses_.back();
  return (first.position - last.position).norm() < kClosed_m &&
         first.orientation.angularDistance(last.orientation) < kClosed_rad;
}

VehiclePose Drive::pose_at(double t_s) const {
  const double duration = duration_s();
  const double lap_s = closed() ? t_s - duration * std::floor(t_s / duration) : t_s;
  const std::int64_t at_ns = nearest_ns(std::clamp(lap_s, 0.0, duration));
  const auto later = std::upper_bound(poses_.begin(), poses_.end(), at_ns,
                                      [](std::int64_t t, const VehiclePose& p) { return t < p.stamp_ns; });
  VehiclePose pose = later == poses_.end() ? poses_.back() : *later;
  if (later != poses_.begin() && later != poses_.end()) {
    const VehiclePose& earlier = *std::prev(later);
    const double share = static_cast<double>(at_ns - earlier.stamp_ns) /
                         static_cast<double>(later->stamp_ns - earlier.stamp_ns);
    pose.position = earlier.position + share * (later->position - earlier.position);
    pose.orientation = earlier.orientation.slerp(share, later->orientation);
  }
  pose.stamp_ns = nearest_ns(t_s);
  return pose;
}

}  // namespace laneloom::simulation
