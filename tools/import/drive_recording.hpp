#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

namespace laneloom::imports {

/// Removes frames that no service could fuse, because there are no poses around their stamp (SyncConfig).
/// Returns how many were removed. Stamps of `poses` must ascend.
std::size_t drop_frames_without_pose(std::vector<DetectionFrame>& frames,
                                     const std::vector<VehiclePose>& poses);

/// Writes poses, frames and objects (stamps ascend) as the recording `path`. Log times are their stamps, so
/// that a frame comes after the pose before it, and before the pose after it. Objects come before a frame of
/// their stamp. Sequences are counted up from 1, in
/// session 1. Throws std::runtime_error naming the file if it exists or cannot be written, or where a message
/// exceeds the bounds of the IDL.
void write_drive(const std::string& path, const std::vector<VehiclePose>& poses,
                 const std::vector<DetectionFrame>& frames, const std::vector<TrackedObjects>& objects = {});

}  // namespace laneloom::imports
