#include "session/pose_buffer.hpp"

#include <algorithm>
#include <cstddef>

#include "base/seconds.hpp"

namespace laneloom::session {
namespace {

// A history of 60 s at 1 kHz fits. This only bounds the memory that a flood of poses takes.
constexpr std::size_t kMostPoses = 65536;

}  // namespace

Eigen::Quaterniond slerp(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to, double share) {
  // The normalised sum of two unit quaternions lies half-way on their arc. Ten halvings leave at most a
  // 1024th of it (0.2 degrees of rotation), on which linear interpolation errs by less than 1e-9 rad.
  constexpr int kHalvings = 10;
  Eigen::Vector4d a = from.coeffs();
  Eigen::Vector4d b = from.dot(to) < 0.0 ? Eigen::Vector4d(-to.coeffs()) : to.coeffs();
  for (int i = 0; i < kHalvings; ++i) {
    const Eigen::Vector4d middle = (a + b).normalized();
    share *= 2.0;
    if (share < 1.0) {
      b = middle;
    } else {
      a = middle;
      share -= 1.0;
    }
  }
  return Eigen::Quaterniond(Eigen::Vector4d(a + (b - a) * share).normalized());
}

void PoseBuffer::add(const VehiclePose& pose) {
  poses_.push_back(pose);
  const auto too_old = [&](const VehiclePose& old) {
    return seconds(pose.stamp_ns - old.stamp_ns) > config_.pose_history_s;
  };
  while (too_old(poses_.front()) || poses_.size() > kMostPoses) poses_.pop_front();
}

void PoseBuffer::drop_from(std::int64_t stamp_ns) {
  while (!poses_.empty() && poses_.back().stamp_ns >= stamp_ns) poses_.pop_back();
}

PoseBuffer::Answer PoseBuffer::at(std::int64_t stamp_ns, Eigen::Isometry3d& T_map_body) const {
  const auto after =
      std::lower_bound(poses_.begin(), poses_.end(), stamp_ns,
                       [](const VehiclePose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; });
  if (after == poses_.end()) return Answer::not_yet;
  if (after->stamp_ns == stamp_ns) {
    T_map_body = transform(*after);
    return Answer::found;
  }
  if (after == poses_.begin()) return Answer::never;
  const auto before = std::prev(after);
  const double gap_s = seconds(after->stamp_ns - before->stamp_ns);
  if (gap_s > config_.max_pose_gap_s) return Answer::never;
  const double share = seconds(stamp_ns - before->stamp_ns) / gap_s;
  VehiclePose pose;
  pose.position = before->position + (after->position - before->position) * share;
  pose.orientation = slerp(before->orientation, after->orientation, share);
  T_map_body = transform(pose);
  return Answer::found;
}

}  // namespace laneloom::session
