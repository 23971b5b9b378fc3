#include "view/moment.hpp"

#include <algorithm>

namespace laneloom::view {
namespace {

/// Number of frames that are kept: more than the service lets wait for their poses.
constexpr std::size_t kFrames = 64;

}  // namespace

bool MomentBuilder::add(DetectionFrame&& frame, std::int64_t) {
  frames_.push_back(std::move(frame));
  if (frames_.size() > kFrames) frames_.pop_front();
  return false;
}

bool MomentBuilder::add(VehiclePose&& pose, std::int64_t) {
  traffic_.add(pose);
  pose_ = std::move(pose);
  return false;
}

bool MomentBuilder::add(PublishedMap&& map, std::int64_t now_ns) {
  complete_ = std::exchange(waiting_, Waiting(std::move(map), now_ns));
  return complete_.has_value();
}

bool MomentBuilder::add(RoadMarkings&& markings, std::int64_t) {
  if (!waiting_ || waiting_->first.sequence != markings.sequence ||
      waiting_->first.session_id != markings.session_id)
    return false;
  waiting_->first.map.markings = std::move(markings.markings);
  complete_ = std::exchange(waiting_, std::nullopt);
  return true;
}

bool MomentBuilder::add(ServiceStatus&& status, std::int64_t) {
  status_ = std::move(status);
  return false;
}

bool MomentBuilder::add(TrackedObjects&& objects, std::int64_t) {
  traffic_.add(std::move(objects));
  return false;
}

ViewMoment MomentBuilder::take() { return moment_of(std::move(*std::exchange(complete_, std::nullopt))); }

std::optional<ViewMoment> MomentBuilder::finish() {
  if (!waiting_) return std::nullopt;
  return moment_of(std::move(*std::exchange(waiting_, std::nullopt)));
}

ViewMoment MomentBuilder::moment_of(Waiting&& waiting) {
  ViewMoment moment{
      .map = std::move(waiting.first), .seen_ns = waiting.second, .pose = pose_, .status = status_};
  const LocalMap& map = moment.map.map;
  moment.traffic = traffic_.at(map.stamp_ns, map.T_map_body.translation());
  const auto fused = std::find_if(frames_.rbegin(), frames_.rend(), [&](const DetectionFrame& frame) {
    return frame.stamp_ns == map.stamp_ns;
  });
  if (fused != frames_.rend()) moment.detections = *fused;
  return moment;
}

}  // namespace laneloom::view
