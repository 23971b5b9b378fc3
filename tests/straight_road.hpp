#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "laneloom/types.hpp"

/// Messages of a car's perception and odometry on a straight road with one lane, and faults on their way.
namespace laneloom {

constexpr std::int64_t kPosePeriod_ms = 10;

/// `time_ms` after the start, at 5 m/s.
inline VehiclePose pose_on_straight_road(std::int64_t time_ms) {
  constexpr std::int64_t kStart_ms = 1'700'000'000'000;
  return {.stamp_ns = (kStart_ms + time_ms) * 1'000'000,
          .sequence = static_cast<std::uint64_t>(time_ms / kPosePeriod_ms),
          .session_id = 5,
          .position = {5.0 * static_cast<double>(time_ms) / 1e3, 0.0, 0.0}};
}

/// A frame that comes late, as a network delivers it: 40 ms after its stamp.
inline DetectionFrame frame_on_straight_road(std::int64_t time_ms, std::int64_t period_ms) {
  DetectionFrame frame{.stamp_ns = pose_on_straight_road(time_ms - 40).stamp_ns,
                       .sequence = static_cast<std::uint64_t>(time_ms / period_ms),
                       .session_id = 6};
  for (const double y_m : {-1.75, 1.75}) {
    frame.detections.push_back(Detection{.confidence = 0.9, .points = {{-5.0, y_m, 0.0}, {25.0, y_m, 0.0}}});
  }
  return frame;
}

/// Gives the messages that are sent instead of one; empty: it is lost.
template <class T>
using Channel = std::function<std::vector<T>(T)>;

/// A message of which nothing arrives.
template <class T>
std::vector<T> lose(const T& /*message*/) {
  return {};
}

/// Everything arrives so many messages later.
template <class T>
Channel<T> delay(std::size_t messages) {
  return [messages, waiting = std::deque<T>()](T message) mutable {
    waiting.push_back(std::move(message));
    if (waiting.size() <= messages) return std::vector<T>{};
    std::vector<T> sent{waiting.front()};
    waiting.pop_front();
    return sent;
  };
}

/// So many messages arrive at once.
template <class T>
Channel<T> bunch(std::size_t messages) {
  return [messages, held = std::vector<T>()](T message) mutable {
    held.push_back(std::move(message));
    return held.size() < messages ? std::vector<T>{} : std::exchange(held, {});
  };
}

/// The frame that another perception stack makes of the same images.
inline DetectionFrame of_source(DetectionFrame frame, const std::string& source, std::uint64_t session) {
  frame.source = source;
  frame.session_id = session;
  return frame;
}

}  // namespace laneloom
