#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace laneloom::core {

/// Tells when frames can be fused: once a pose as new as their stamp has come. Not thread-safe.
class Readiness {
 public:
  /// Notes a frame; returns whether it is ready.
  bool note_frame(std::int64_t stamp_ns) {
    if (newest_pose_ns_ && stamp_ns <= *newest_pose_ns_) return true;
    if (waiting_ns_.size() == kMaxWaiting) waiting_ns_.erase(waiting_ns_.begin());
    waiting_ns_.push_back(stamp_ns);
    return false;
  }
  /// Notes a pose; returns the number of frames that waited for it. A pose of a new clock may be older than
  /// the one before.
  std::size_t note_pose(std::int64_t stamp_ns) {
    newest_pose_ns_ = stamp_ns;
    return std::erase_if(waiting_ns_, [&](std::int64_t frame_ns) { return frame_ns <= stamp_ns; });
  }

 private:
  static constexpr std::size_t kMaxWaiting = 64;  // frames of which no pose tells are of no use to the phase
  std::optional<std::int64_t> newest_pose_ns_;
  std::vector<std::int64_t> waiting_ns_;  ///< stamps of frames, in the order of their arrival
};

}  // namespace laneloom::core
