#include "view/traffic.hpp"

#include <utility>

#include "base/seconds.hpp"
#include "session/gate.hpp"

namespace laneloom::view {
namespace {

constexpr double kShown_s = 1.0;  ///< without a newer message of its tracker

}  // namespace

TrafficFollower::TrafficFollower() : poses_(config_.sync), pending_(config_) {}

void TrafficFollower::add(const VehiclePose& pose) {
  if (newest_pose_ && newest_pose_->session_id != pose.session_id) forget();
  if (newest_pose_ && pose.stamp_ns <= newest_pose_->stamp_ns) return;
  newest_pose_ = pose;
  poses_.add(pose);
}

void TrafficFollower::add(TrackedObjects objects) {
  if (!newest_pose_ || !session::defect(objects, config_.gate).empty()) return;
  pending_.add(std::move(objects), newest_pose_->stamp_ns);
  pending_.drop_excess();
}

Traffic TrafficFollower::at(std::int64_t stamp_ns, const Point& vehicle) {
  while (auto objects = pending_.take_until(stamp_ns)) {
    Eigen::Isometry3d T_map_body;
    if (poses_.at(objects->stamp_ns, T_map_body) != session::PoseBuffer::Answer::found) continue;
    const TrackedObjects now = in_body_frame(*std::move(objects), T_map_body);
    trails_.add(now, T_map_body);
    seen_[now.session_id] = {now, T_map_body};
  }
  trails_.keep_around(vehicle);
  std::erase_if(
      seen_, [&](const auto& entry) { return seconds(stamp_ns - entry.second.objects.stamp_ns) > kShown_s; });
  Traffic traffic{.seen = {}, .trails = trails_.all()};
  for (const auto& [session, seen] : seen_) traffic.seen.push_back(seen);
  return traffic;
}

void TrafficFollower::forget() {
  newest_pose_.reset();
  poses_.clear();
  pending_.clear();
  trails_ = {};
  seen_.clear();
}

}  // namespace laneloom::view
