#pragma once

#include <cstdint>
#include <deque>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::session {

/// The newest poses. Interpolates between them, and never extrapolates.
class PoseBuffer {
 public:
  explicit PoseBuffer(const SyncConfig& config) : config_(config) {}

  /// Stamps must ascend.
  void add(const VehiclePose& pose);
  void clear() { poses_.clear(); }
  /// Forgets the poses of a stamp and after it.
  void drop_from(std::int64_t stamp_ns);

  enum class Answer {
    found,    ///< the result is set
    not_yet,  ///< no pose is as new as the stamp
    never     ///< the stamp is older than all poses, or the poses around it are too far apart
  };
  /// Interpolates T_map_body at a stamp. The two poses around it must be at most max_pose_gap_s apart.
  /// Position is interpolated linearly, orientation on the great arc.
  Answer at(std::int64_t stamp_ns, Eigen::Isometry3d& T_map_body) const;

 private:
  SyncConfig config_;
  std::deque<VehiclePose> poses_;
};

/// The orientation at `share` (0..1) of the shorter way from `from` to `to`; both of unit length.
/// Uses no function whose last bits depend on the CPU.
Eigen::Quaterniond slerp(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to, double share);

}  // namespace laneloom::session
