#include "participants.hpp"

#include <unistd.h>

#include <chrono>
#include <string>

namespace laneloom {
namespace {

constexpr std::int64_t kStart_ms = 1'700'000'000'000;
constexpr double kSpeed_mps = 5.0;

}  // namespace

DdsConfig private_config(const std::string& name) {
  DdsConfig config;
  config.domain = 1 + getpid() % 90;  // the ports of higher domains are used by others
  config.vehicle_id = name + std::to_string(getpid());
  return config;
}

StraightRoad::StraightRoad(const DdsConfig& config)
    : participant_(config, "straight road"), detections_(participant_), poses_(participant_) {
  thread_ = std::jthread([this](const std::stop_token& stopped) { run(stopped); });
}

StraightRoad::~StraightRoad() { stop(); }

void StraightRoad::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void StraightRoad::damage_frames(std::function<void(DetectionFrame&)> damage) {
  const std::lock_guard lock(mutex_);
  damage_ = std::move(damage);
}

void StraightRoad::run(const std::stop_token& stopped) {
  while (!stopped.stop_requested() && (detections_.matched() == 0 || poses_.matched() == 0)) usleep(10'000);
  auto next = std::chrono::steady_clock::now();
  for (std::int64_t stamp_ms = kStart_ms; !stopped.stop_requested(); stamp_ms += 10) {
    write(stamp_ms);
    next += std::chrono::milliseconds(10);
    std::this_thread::sleep_until(next);
  }
}

void StraightRoad::write(std::int64_t stamp_ms) {
  const auto step = static_cast<std::uint64_t>(stamp_ms - kStart_ms) / 10;
  const double x_m = kSpeed_mps * static_cast<double>(step) * 0.01;
  poses_.write(
      {.stamp_ns = stamp_ms * 1'000'000, .sequence = step, .session_id = 5, .position = {x_m, 0.0, 0.0}});
  if (step % 10 != 5) return;
  // As a network does, it delivers late.
  DetectionFrame frame{.stamp_ns = (stamp_ms - 40) * 1'000'000, .sequence = step / 10, .session_id = 6};
  for (const double y_m : {-1.75, 1.75}) {
    frame.detections.push_back(Detection{.confidence = 0.9, .points = {{-5.0, y_m, 0.0}, {25.0, y_m, 0.0}}});
  }
  {
    const std::lock_guard lock(mutex_);
    if (damage_ && frame.sequence % 2 == 1) damage_(frame);
  }
  detections_.write(frame);
  ++frames_written_;
}

}  // namespace laneloom
