#include "mapping/pose_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/degree.hpp"
#include "base/seconds.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/map_fit.hpp"

namespace laneloom {
namespace {

constexpr std::size_t kPosesRemembered = 16;
constexpr std::size_t kJumpsRemembered = 8;
constexpr double kLongestStep_s = 1.0;     // after a longer pause, nothing tells where the vehicle should be
constexpr double kMostExtrapolated = 1.5;  // of the time that the motion before was measured over
constexpr int kFramesToDecide = 3, kFramesToWait = 12;

// A larger step is suspected. A vehicle that brakes or turns abruptly exceeds it as well; the detections
// decide.
constexpr double kLeastStep_m = 0.1, kAcceleration_mps2 = 8.0;
constexpr double kLeastTurn_deg = 0.5, kTurnAcceleration_degps2 = 30.0;
// Hardly any vehicle accelerates like that for longer than 0.2 s. Where frames are rare, a larger step is
// suspected as well, but the detections have to tell more.
constexpr double kUsualTolerance_s2 = 0.04;
constexpr double kLever_m = 15.0;  // what a turn weighs, in metres: it moves what is seen from that far

// The share of a suspected jump that may prove to be another error, as of the frame.
constexpr double kMostLeft = 0.4;
// What the pose without the jump has to explain beyond what the told pose explains, in metres of detections.
constexpr double kLeastGain_m = 4.0, kLeastGain = 0.05;
// Poses that come away little by little: two frames in a row fit better from about the same other place.
constexpr double kLeastAway_m = 0.2, kLeastAwayGain = 0.25, kMostAwayChange = 0.5;

Eigen::Vector2d heading(const Eigen::Isometry3d& T_map_body) {
  return T_map_body.linear().col(0).head<2>().normalized();
}

/// The motion, about the vertical, that takes one pose to another.
Eigen::Isometry3d motion_between(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  const Eigen::Vector2d before = heading(from), after = heading(to);
  const double cosine = before.dot(after), sine = cross(before, after);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear().topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
  motion.translation() = to.translation() - motion.linear() * from.translation();
  return motion;
}

/// How far two poses are apart: metres, and the turn by its lever.
double apart_m(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).head<2>().norm() +
         kLever_m * std::abs(cross(heading(a), heading(b)));
}

/// The pose after a further motion like that from `before` to `last`, `share` times as long. A share near 1
/// leaves the turn as it is to the third order.
Eigen::Isometry3d continued(const Eigen::Isometry3d& before, const Eigen::Isometry3d& last, double share) {
  const Eigen::Isometry3d step = before.inverse() * last;
  const Eigen::Quaterniond turn(step.linear());
  const Eigen::Quaterniond still = Eigen::Quaterniond::Identity();
  const Eigen::Quaterniond scaled((1.0 - share) * still.coeffs() + share * turn.coeffs());
  return last * Eigen::Translation3d(share * step.translation()) * scaled.normalized();
}

/// The vehicle's pose without the jump, in the map of before, if the detections tell that there was one.
std::optional<Eigen::Isometry3d> pose_without(const SuspectedJump& jump, const Eigen::Isometry3d& told,
                                              const MapFit& fit) {
  const Eigen::Isometry3d predicted = jump.motion.inverse() * told;
  const Eigen::Isometry3d fitted = fit.refined(predicted);
  if (apart_m(fitted, predicted) > kMostLeft * apart_m(told, predicted)) return std::nullopt;
  const double explained_m = fit.explained_m(told);
  const double gain_m = std::max(fit.explained_m(predicted) - explained_m,
                                 fit.explained_m(fitted) - fit.explained_m(fit.refined(told)));
  if (gain_m < std::max(kLeastGain_m, jump.least_gain * explained_m)) return std::nullopt;
  return fitted;
}

}  // namespace

std::optional<Eigen::Isometry3d> PoseJumps::find(const DetectionFrame& frame,
                                                 const Eigen::Isometry3d& T_map_body,
                                                 const std::vector<Marking>& map_markings,
                                                 bool stays_behind) {
  const Stamped pose{frame.stamp_ns, T_map_body};
  if (!suspected_) {
    suspected_ = suspect(pose);
    frames_since_ = doubtful_frames_ = 0;
  }
  poses_.push_back(pose);
  if (poses_.size() > kPosesRemembered) poses_.pop_front();
  if (!suspected_ && !stays_behind) {
    away_.reset();
    return std::nullopt;
  }
  const MapFit fit(frame, map_markings, T_map_body);
  if (!suspected_) return come_away(fit, pose);
  away_.reset();
  const auto true_pose = pose_without(*suspected_, T_map_body, fit);
  if (!true_pose) {
    ++frames_since_;
    if (fit.length_m() >= kLeastGain_m) ++doubtful_frames_;
    if (doubtful_frames_ == kFramesToDecide || frames_since_ == kFramesToWait) suspected_.reset();
    return std::nullopt;
  }
  const Eigen::Isometry3d motion = motion_between(*true_pose, T_map_body);
  accept({frame.stamp_ns, motion});
  return motion;
}

/// The motion from where the vehicle should be to where it is, if no vehicle moves like that.
std::optional<SuspectedJump> PoseJumps::suspect(const Stamped& pose) const {
  if (poses_.size() < 2) return std::nullopt;
  const Stamped& last = poses_.back();
  const double step_s = seconds(pose.stamp_ns - last.stamp_ns);
  if (step_s <= 0.0 || step_s > kLongestStep_s) return std::nullopt;
  // The motion before is measured over about as long as it is continued for.
  const auto before = std::ranges::min_element(
      poses_.begin(), poses_.end() - 1, {},
      [&](const Stamped& past) { return std::abs(seconds(last.stamp_ns - past.stamp_ns) - step_s); });
  const double before_s = seconds(last.stamp_ns - before->stamp_ns);
  if (before_s <= 0.0 || step_s > kMostExtrapolated * before_s) return std::nullopt;
  const Eigen::Isometry3d expected = continued(before->transform, last.transform, step_s / before_s);
  const double moved_m = (pose.transform.translation() - expected.translation()).head<2>().norm();
  const double turned = std::abs(cross(heading(expected), heading(pose.transform)));
  const auto exceeds = [&](double tolerance_s2) {
    return moved_m >= kLeastStep_m + kAcceleration_mps2 * tolerance_s2 ||
           turned >= kDegree * (kLeastTurn_deg + kTurnAcceleration_degps2 * tolerance_s2);
  };
  const double tolerance_s2 = 0.5 * step_s * (step_s + before_s);
  if (!exceeds(std::min(tolerance_s2, kUsualTolerance_s2))) return std::nullopt;
  return SuspectedJump{motion_between(expected, pose.transform),
                       exceeds(tolerance_s2) ? kLeastGain : kLeastAwayGain};
}

/// The motion by which the poses have come away, if this frame and the one before tell it.
std::optional<Eigen::Isometry3d> PoseJumps::come_away(const MapFit& fit, const Stamped& pose) {
  const auto before = std::exchange(away_, std::nullopt);
  const Eigen::Isometry3d& told = pose.transform;
  const Eigen::Isometry3d fitted = fit.refined(told);
  const double explained_m = fit.explained_m(told), away_m = apart_m(fitted, told);
  if (away_m < kLeastAway_m ||
      fit.explained_m(fitted) - explained_m < std::max(kLeastGain_m, kLeastAwayGain * explained_m))
    return std::nullopt;
  away_ = motion_between(fitted, told);
  if (!before || apart_m(*away_ * told, *before * told) > kMostAwayChange * away_m) return std::nullopt;
  frames_since_ = 0;
  accept({pose.stamp_ns, *away_});
  return std::exchange(away_, std::nullopt);
}

/// Notes a jump. The poses before it, the pose of the jump excepted, move with the map.
void PoseJumps::accept(const Stamped& jump) {
  const auto jumped = poses_.end() - 1 - frames_since_;
  for (auto past = poses_.begin(); past != jumped; ++past) past->transform = jump.transform * past->transform;
  jumps_.push_back({jumped->stamp_ns, jump.transform});
  if (jumps_.size() > kJumpsRemembered) jumps_.pop_front();
  suspected_.reset();
}

Eigen::Isometry3d PoseJumps::as_of_now(std::int64_t stamp_ns, Eigen::Isometry3d T_map_body) const {
  for (const Stamped& jump : jumps_)
    if (stamp_ns < jump.stamp_ns) T_map_body = jump.transform * T_map_body;
  return T_map_body;
}

}  // namespace laneloom
