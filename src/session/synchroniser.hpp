#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "session/pose_buffer.hpp"

namespace laneloom::session {

/// A frame that waits for its poses.
struct PendingFrame {
  DetectionFrame frame;
  std::int64_t arrival_ns = 0;  ///< by the clock of expire()
};

/// A frame and the pose at its stamp.
struct SynchronisedFrame {
  PendingFrame pending;
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
};

/// Holds frames, in the order of their stamps, until the poses around their stamps are there.
class Synchroniser {
 public:
  explicit Synchroniser(const SyncConfig& config) : config_(config), poses_(config) {}

  void add(const VehiclePose& pose) { poses_.add(pose); }
  void add(PendingFrame frame) { pending_.emplace(frame.frame.stamp_ns, std::move(frame)); }

  /// Takes out the oldest frame, if it can be fused now. Older frames that never can be fused are removed and
  /// counted in `refused`.
  std::optional<SynchronisedFrame> next(std::size_t& refused);
  /// Removes the frames that have waited for their poses for longer than max_wait_s; returns how many.
  std::size_t expire(std::int64_t now_ns);
  /// Removes frames above the capacity, each time the oldest of the source that has the most. Returns how
  /// many.
  std::size_t drop_excess();
  /// Removes all frames; returns how many.
  std::size_t clear_frames();
  void clear_poses() { poses_.clear(); }
  void drop_poses_from(std::int64_t stamp_ns) { poses_.drop_from(stamp_ns); }
  /// The pose at a stamp.
  PoseBuffer::Answer pose_at(std::int64_t stamp_ns, Eigen::Isometry3d& T_map_body) const {
    return poses_.at(stamp_ns, T_map_body);
  }

  std::size_t pending() const { return pending_.size(); }
  /// Number of frames that can be fused now.
  std::size_t ready() const;

 private:
  std::string_view source_with_most() const;

  SyncConfig config_;
  PoseBuffer poses_;
  std::multimap<std::int64_t, PendingFrame> pending_;  ///< by stamp
};

}  // namespace laneloom::session
