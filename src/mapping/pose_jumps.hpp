#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

class MapFit;

/// A step of the poses that the detections have to decide about.
struct SuspectedJump {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();  ///< map frame
  double least_gain = 0.0;  ///< share of the explained detections that have to speak for it

  template <class Archive>
  void serialize(Archive& archive) {
    archive(motion, least_gain);
  }
};

/// Tells jumps of the poses from motions of the vehicle. A jump is a step that no vehicle makes, and that the
/// detections contradict: they fit the map better from where the vehicle would be without the step. Ours.
class PoseJumps {
 public:
  /// Takes the newest frame, with its pose. `map_markings` are those of the map before, and `stays_behind`
  /// tells whether the frame before fitted them badly. Returns the motion, map frame, by which the poses have
  /// jumped, or come away little by little: whatever was mapped before lies that much elsewhere now. None:
  /// they have not, or the detections do not tell.
  std::optional<Eigen::Isometry3d> find(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                                        const std::vector<Marking>& map_markings, bool stays_behind);

  /// The pose of a frame in the map frame of now: a frame of before a jump is seen from elsewhere.
  Eigen::Isometry3d as_of_now(std::int64_t stamp_ns, Eigen::Isometry3d T_map_body) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(poses_, jumps_, suspected_, frames_since_, doubtful_frames_, away_);
  }

 private:
  /// A pose, or the motion of a jump.
  struct Stamped {
    std::int64_t stamp_ns = 0;
    Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();

    template <class Archive>
    void serialize(Archive& archive) {
      archive(stamp_ns, transform);
    }
  };

  std::optional<SuspectedJump> suspect(const Stamped& pose) const;
  std::optional<Eigen::Isometry3d> come_away(const MapFit& fit, const Stamped& pose);
  void accept(const Stamped& jump);

  std::deque<Stamped> poses_;               ///< of the newest frames, in the order of their stamps
  std::deque<Stamped> jumps_;               ///< the last ones
  std::optional<SuspectedJump> suspected_;  ///< a jump that no detection has decided yet
  std::optional<Eigen::Isometry3d> away_;   ///< motion by which the frame before had come away
  int frames_since_ = 0;                    ///< number of frames since its first pose
  int doubtful_frames_ = 0;                 ///< number of those that could have decided it
};

}  // namespace laneloom
