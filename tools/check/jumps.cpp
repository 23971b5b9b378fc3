#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/degree.hpp"
#include "base/distribution.hpp"
#include "base/seconds.hpp"
#include "check/findings.hpp"

namespace laneloom::check {
namespace {

constexpr double kLongestStep_s = 1.0;  // over longer ones, nothing is known of the way between
constexpr double kUsualTimes = 10.0;    // a jump is so many times what is usual
// What no vehicle does, beyond what it does before and after: so much in a step, and more in a longer one.
constexpr double kLeast_m = 0.2, kAcceleration_mps2 = 6.0;
constexpr double kLeast_deg = 0.7, kTurnAcceleration_degps2 = 60.0;

/// A step between two poses, beyond what the steps before and after it explain, and what is still no jump.
struct Step {
  std::int64_t stamp_ns = 0;  ///< at its end
  double shift_m = 0.0, turn_deg = 0.0;
  double most_m = 0.0, most_deg = 0.0;
};

Eigen::Vector2d velocity(const VehiclePose& from, const VehiclePose& to) {
  return (to.position - from.position).head<2>() / seconds(to.stamp_ns - from.stamp_ns);
}

double yaw_rate(const VehiclePose& from, const VehiclePose& to) {
  const Point nose = from.orientation.conjugate() * (to.orientation * Point::UnitX());
  return std::atan2(nose.y(), nose.x()) / kDegree / seconds(to.stamp_ns - from.stamp_ns);
}

/// How far a velocity is from all velocities between two others. A vehicle that brakes hard keeps between
/// them.
double beyond(const Eigen::Vector2d& velocity, const Eigen::Vector2d& before, const Eigen::Vector2d& after) {
  const Eigen::Vector2d change = after - before;
  const double length2 = change.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp(change.dot(velocity - before) / length2, 0.0, 1.0) : 0.0;
  return (velocity - before - share * change).norm();
}

std::vector<Step> steps_of(const std::vector<VehiclePose>& poses) {
  std::vector<Step> steps;
  for (std::size_t i = 2; i + 1 < poses.size(); ++i) {
    const VehiclePose &a = poses[i - 2], &b = poses[i - 1], &c = poses[i], &d = poses[i + 1];
    if (seconds(d.stamp_ns - a.stamp_ns) > 3.0 * kLongestStep_s) continue;
    if (a.session_id != d.session_id) continue;  // the map begins anew
    const double length_s = seconds(c.stamp_ns - b.stamp_ns);
    const auto [least, most] = std::minmax({yaw_rate(a, b), yaw_rate(c, d)});
    const double turn = yaw_rate(b, c);
    steps.push_back({c.stamp_ns, beyond(velocity(b, c), velocity(a, b), velocity(c, d)) * length_s,
                     std::abs(turn - std::clamp(turn, least, most)) * length_s,
                     kLeast_m + kAcceleration_mps2 * length_s * length_s,
                     kLeast_deg + kTurnAcceleration_degps2 * length_s * length_s});
  }
  return steps;
}

double usual(const std::vector<Step>& steps, double Step::*value) {
  Distribution values;
  for (const Step& step : steps) values.add(step.*value);
  return values.quantile(0.9);
}

}  // namespace

Findings jump_findings(const PoseTrack& poses, const Correction& correction) {
  std::vector<VehiclePose> right = poses.poses();
  for (VehiclePose& pose : right) pose = corrected(pose, correction);
  const std::vector<Step> steps = steps_of(right);
  const double usual_m = usual(steps, &Step::shift_m), usual_deg = usual(steps, &Step::turn_deg);
  std::vector<Step> jumps;
  std::ranges::copy_if(steps, std::back_inserter(jumps), [&](const Step& step) {
    return step.shift_m > std::max(step.most_m, kUsualTimes * usual_m) ||
           step.turn_deg > std::max(step.most_deg, kUsualTimes * usual_deg);
  });
  if (jumps.empty()) return {};
  const Step& first = jumps.front();
  return {
      {"pose_jump",
       fmt::format("The poses jump at {} places; first at stamp {:.3f} s, by {:.2f} m and {:.1f} degrees.",
                   jumps.size(), seconds(first.stamp_ns), first.shift_m, first.turn_deg),
       "Give odometry that does not jump, or begin a new session_id of poses where it does: that clears the "
       "map. "
       "The service does so beyond gate.max_pose_jump_m and gate.max_pose_turn_deg."}};
}

}  // namespace laneloom::check
