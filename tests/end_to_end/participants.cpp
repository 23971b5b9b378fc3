#include "participants.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "own_domain.hpp"

namespace laneloom {
namespace {

constexpr std::int64_t kStep_ms = 5;

}  // namespace

DdsConfig private_config(const std::string& name) {
  DdsConfig config;
  config.domain = own_domain();
  config.vehicle_id = name + std::to_string(getpid());
  return config;
}

StraightRoad::StraightRoad(const DdsConfig& config, int frame_period_ms)
    : participant_(config, "straight road"),
      detections_(participant_),
      poses_(participant_),
      frame_period_ms_(frame_period_ms) {
  thread_ = std::jthread([this](const std::stop_token& stopped) { run(stopped); });
}

StraightRoad::~StraightRoad() { stop(); }

void StraightRoad::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void StraightRoad::send_frames(Channel<DetectionFrame> channel) {
  const std::lock_guard lock(mutex_);
  frame_channel_ = std::move(channel);
}

void StraightRoad::send_poses(Channel<VehiclePose> channel) {
  const std::lock_guard lock(mutex_);
  pose_channel_ = std::move(channel);
}

void StraightRoad::run(const std::stop_token& stopped) {
  while (!stopped.stop_requested() && (detections_.matched() == 0 || poses_.matched() == 0)) usleep(10'000);
  auto next = std::chrono::steady_clock::now();
  for (std::int64_t time_ms = 0; !stopped.stop_requested(); time_ms += kStep_ms) {
    if (time_ms % kPosePeriod_ms == 0) write_pose(time_ms);
    if (time_ms > 0 && time_ms % frame_period_ms_ == 0) write_frame(time_ms);
    // The road's time goes slower on a slow host: messages in a burst would push one another out.
    next = std::max(next + std::chrono::milliseconds(kStep_ms), std::chrono::steady_clock::now());
    std::this_thread::sleep_until(next);
  }
}

void StraightRoad::write_pose(std::int64_t time_ms) {
  const VehiclePose pose = pose_on_straight_road(time_ms);
  const std::lock_guard lock(mutex_);
  for (const auto& sent : pose_channel_ ? pose_channel_(pose) : std::vector{pose}) poses_.write(sent);
}

void StraightRoad::write_frame(std::int64_t time_ms) {
  const DetectionFrame frame = frame_on_straight_road(time_ms, frame_period_ms_);
  const std::lock_guard lock(mutex_);
  for (const auto& sent : frame_channel_ ? frame_channel_(frame) : std::vector{frame}) {
    detections_.write(sent);
    ++frames_written_;
  }
}

}  // namespace laneloom
