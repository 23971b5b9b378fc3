#pragma once

#include <cstdint>
#include <deque>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// The newest poses, to interpolate between. Never extrapolates.
class PoseBuffer {
 public:
  explicit PoseBuffer(const SyncConfig& config) : config_(config) {}

  /// Stamps must ascend.
  void add(const VehiclePose& pose);
  void clear() { poses_.clear(); }

  enum class Answer {
    found,
    not_yet,  ///< no pose is as new as the stamp
    never     ///< older than all poses, or its neighbours are too far apart
  };
  /// T_map_body at a stamp, for which the two poses around it must be at most max_pose_gap_s apart.
  /// Position is interpolated linearly, orientation on the great arc.
  Answer at(std::int64_t stamp_ns, Eigen::Isometry3d& T_map_body) const;

 private:
  SyncConfig config_;
  std::deque<VehiclePose> poses_;
};

/// The orientation at `share` (0..1) of the shorter way from `from` to `to`; both of unit length.
/// Uses no function whose last bits depend on the CPU.
Eigen::Quaterniond slerp(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to, double share);

}  // namespace laneloom
