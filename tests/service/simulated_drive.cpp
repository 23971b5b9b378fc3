#include "simulated_drive.hpp"

#include <algorithm>
#include <utility>

#include "laneloom/state_names.hpp"
#include "milliseconds.hpp"
#include "service/executor.hpp"

namespace laneloom::service {

SimulatedDrive::SimulatedDrive(const Config& config, std::int64_t frame_period_ms)
    : frame_period_ms_(frame_period_ms), config_(config), queue_(config, [this] { frame_is_ready_ = true; }) {
  start();
}

void SimulatedDrive::start() {
  const auto steady_now_ns = [this] { return now_ns_; };
  const auto system_now_ns = [this] { return now_ns_ + (1'700'000'000'000 + clock_jump_ms) * kMs; };
  core_ = std::make_unique<core::ServiceCore>(
      config_, core::Surroundings{steady_now_ns, system_now_ns, [this] { return next_id_++; }});
  core_->observe(this);
}

void SimulatedDrive::restart() {
  start();
  if (snapshot_) core_->resume(*std::exchange(snapshot_, std::nullopt));
}

void SimulatedDrive::run_for(std::int64_t duration_ms) {
  maps_.clear();
  statuses_.clear();
  const std::int64_t end_ns = now_ns_ + duration_ms * kMs;
  const auto sleep_until = [&](std::int64_t deadline_ns) {
    frame_is_ready_ = false;
    for (deliver(); !frame_is_ready_ && now_ns_ < std::min(deadline_ns, end_ns); deliver())
      now_ns_ = std::min({deadline_ns, end_ns, now_ns_ + kMs});
    return now_ns_ < end_ns;
  };
  run_periodically(100 * kMs,
                   {[this] { return now_ns_; }, sleep_until, [this] { return queue_.take_ready(); }},
                   [this](const core::Tick& now) { tick(now); });
}

void SimulatedDrive::deliver() {
  for (; start_ns_ + delivered_ms_ * kMs <= now_ns_; delivered_ms_ += 5) {
    const std::int64_t arrival_ns = start_ns_ + delivered_ms_ * kMs;
    if (delivered_ms_ % kPosePeriod_ms == 0) {
      const auto pose = pose_on_straight_road(delivered_ms_);
      for (auto& sent : send_poses ? send_poses(pose) : std::vector{pose})
        queue_.push(std::move(sent), arrival_ns);
    }
    if (delivered_ms_ > 0 && delivered_ms_ % frame_period_ms_ == 0) {
      const auto frame = frame_on_straight_road(delivered_ms_, frame_period_ms_);
      for (auto& sent : send_frames ? send_frames(frame) : std::vector{frame})
        queue_.push(std::move(sent), arrival_ns);
    }
  }
}

void SimulatedDrive::tick(const core::Tick& tick) {
  core::Messages messages = core_->tick(tick, queue_.take());
  maps_.push_back(std::move(messages.map));
  if (messages.snapshot) snapshot_ = std::move(messages.snapshot);
  if (!messages.status) return;
  counters_ = {messages.status->counters.begin(), messages.status->counters.end()};
  statuses_.push_back(std::move(*messages.status));
}

std::vector<std::string> SimulatedDrive::states() const {
  std::vector<std::string> changes;
  for (const PublishedMap& map : maps_) {
    const std::string now = state_text(map.state, map.reasons);
    if (changes.empty() || changes.back() != now) changes.push_back(now);
  }
  return changes;
}

std::string SimulatedDrive::state() const { return state_text(maps_.back().state, maps_.back().reasons); }

std::vector<FusedFrame> SimulatedDrive::fused() const {
  std::vector<FusedFrame> all;
  for (const PublishedMap& map : maps_)
    all.insert(all.end(), map.fused_frames.begin(), map.fused_frames.end());
  return all;
}

std::uint64_t SimulatedDrive::counter(const std::string& name) const {
  const auto found = counters_.find(name);
  return found == counters_.end() ? 0 : found->second;
}

}  // namespace laneloom::service
