#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "check/correction.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"
#include "replay/message_source.hpp"

namespace laneloom::check {

/// The inputs of a drive as they came.
struct Drive {
  std::vector<VehiclePose> poses;                             ///< in the order of the file
  std::map<std::string, std::vector<DetectionFrame>> frames;  ///< by source, in the order of the file
  std::vector<TrackedObjects> objects;                        ///< in the order of the file
  std::vector<NextTurn> next_turns;                           ///< in the order of the file
};

/// Reads all detections, poses, objects and turns. Calls on_step() for each message with the share of the
/// file that was read, 0..1.
Drive read_drive(
    replay::MessageSource& source,
    const std::function<void(double share)>& on_step = [](double /*share*/) {});

/// The places in a drive's poses at which another run begins, in the order of the file: stamps go back there
/// by more than a second, and each run has 20 poses or more. In a drive that is out of order, runs are
/// shorter.
std::vector<std::size_t> later_runs(const std::vector<VehiclePose>& poses);

/// Poses by their stamps. Not changed after it is made, so that several threads may read it.
class PoseTrack {
 public:
  explicit PoseTrack(std::vector<VehiclePose> poses);

  /// T_map_body at a stamp, of the corrected poses: between the two poses around it, which are at most 2 s
  /// apart.
  std::optional<Eigen::Isometry3d> at(std::int64_t stamp_ns, const Correction& correction) const;
  const std::vector<VehiclePose>& poses() const { return poses_; }  ///< stamps ascend, each once

 private:
  std::vector<VehiclePose> poses_;
};

}  // namespace laneloom::check
