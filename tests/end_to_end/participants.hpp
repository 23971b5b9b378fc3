#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "laneloom/dds/reader.hpp"
#include "laneloom/dds/writer.hpp"
#include "laneloom/messages.hpp"
#include "straight_road.hpp"

namespace laneloom {

/// A domain and vehicle of this test process alone; `name` tells its vehicles apart.
DdsConfig private_config(const std::string& name = "car");

/// Perception and odometry of a car on a straight road with one lane: frames at 10 Hz or another rate, poses
/// at 100 Hz, in a thread of its own. Stamps advance by exactly that, however slow the host is.
class StraightRoad {
 public:
  explicit StraightRoad(const DdsConfig& config, int frame_period_ms = 100);
  ~StraightRoad();

  /// Sets what goes wrong on the way from now on; an empty function: nothing.
  void send_frames(Channel<DetectionFrame> channel);
  void send_poses(Channel<VehiclePose> channel);
  std::uint64_t frames_written() const { return frames_written_; }
  /// Ends the thread; nothing is written any more.
  void stop();

 private:
  void run(const std::stop_token& stopped);
  void write_pose(std::int64_t time_ms);
  void write_frame(std::int64_t time_ms);

  dds::Participant participant_;
  dds::Writer<DetectionFrame> detections_;
  dds::Writer<VehiclePose> poses_;
  std::mutex mutex_;
  Channel<DetectionFrame> frame_channel_;
  Channel<VehiclePose> pose_channel_;
  int frame_period_ms_;
  std::atomic<std::uint64_t> frames_written_ = 0;
  std::jthread thread_;
};

/// Whether the guard in front of DDS has refused anything.
inline bool refused_datagrams(const ServiceStatus& status) {
  return std::ranges::any_of(
      status.counters, [](const auto& counter) { return counter.first.starts_with("datagrams_refused_"); });
}

/// Reads one topic, and keeps what came.
template <class T>
class Listener {
 public:
  explicit Listener(const DdsConfig& config)
      : participant_(config, "listener"), reader_(participant_, callbacks()) {}

  /// Waits (for `patience` at most) for a sample that comes after this call, or for one since the last
  /// forget(), for which `wanted` is true.
  bool wait_for(const std::function<bool(const T&)>& wanted,
                std::chrono::milliseconds patience = std::chrono::seconds(30)) {
    std::unique_lock lock(mutex_);
    std::size_t seen = 0;
    return changed_.wait_for(lock, patience, [&] {
      for (; seen < samples_.size(); ++seen) {
        if (wanted(samples_[seen])) return true;
      }
      return false;
    });
  }
  bool wait_for_alive(int writers) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(30), [&] { return alive_ == writers; });
  }
  bool refused_datagrams() const { return !participant_.refused_datagrams().values().empty(); }
  std::vector<T> samples() {
    const std::lock_guard lock(mutex_);
    return samples_;
  }
  void forget() {
    const std::lock_guard lock(mutex_);
    samples_.clear();
  }

 private:
  dds::ReaderCallbacks<T> callbacks() {
    dds::ReaderCallbacks<T> result;
    result.sample = [this](T&& sample) {
      const std::lock_guard lock(mutex_);
      samples_.push_back(std::move(sample));
      changed_.notify_all();
    };
    result.alive = [this](int writers) {
      const std::lock_guard lock(mutex_);
      alive_ = writers;
      changed_.notify_all();
    };
    return result;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> samples_;
  int alive_ = 0;
  dds::Participant participant_;
  dds::Reader<T> reader_;
};

}  // namespace laneloom
