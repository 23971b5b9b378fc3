#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/left_out.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

namespace laneloom::imports {

/// Removes frames that no service could fuse, because there are no poses around their stamp (SyncConfig).
/// Returns how many were removed. Stamps of `poses` must ascend.
std::size_t drop_frames_without_pose(std::vector<DetectionFrame>& frames,
                                     const std::vector<VehiclePose>& poses);

/// What a drive may do without.
struct OtherInputs {
  std::vector<TrackedObjects> objects = {};
  std::vector<NextTurn> next_turns = {};
};

/// Writes the inputs of a drive (stamps ascend) as the recording `path`. Log times are their stamps, so that
/// a frame comes after the pose before it, and before the pose after it. Other inputs come before a frame of
/// their stamp. Sequences are counted up from 1. Messages without a session are of session 1. Returns what
/// was left out, because it exceeds the bounds of the IDL; that is an error if the writing is `strict`.
/// Throws std::runtime_error if the file exists or cannot be written; it leaves no half file.
LeftOut write_drive(const std::string& path, const std::vector<VehiclePose>& poses,
                    const std::vector<DetectionFrame>& frames, const OtherInputs& others = {},
                    bool strict = false);

}  // namespace laneloom::imports
