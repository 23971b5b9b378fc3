#pragma once

#include <filesystem>
#include <functional>

#include "laneloom/counters.hpp"
#include "laneloom/types.hpp"

/// What is evaluated, from files of either kind: JSON lines (io/json_lines.hpp) or a recording
/// (recording/recording.hpp), told apart by their first bytes. Both throw std::runtime_error naming the file
/// and the place in it where it cannot be read or is malformed.
namespace laneloom {

/// What was there to visit, and what a recording has that cannot be read.
struct InputAccount {
  std::size_t count = 0;  ///< of frames or maps in the file, visited or not
  Counters refused;       ///< messages that were passed over, as "<topic>: <reason>"
  bool cut_off = false;   ///< the file ends before its end
};

/// Calls visit() for every frame with T_map_body at its stamp, in the order of the stamps; what is not later
/// than a frame before it is left out. Of a recording, these are the frames and poses that a service would
/// believe; those without poses around them are left out.
InputAccount for_each_frame(
    const std::filesystem::path& path,
    const std::function<void(const DetectionFrame&, const Eigen::Isometry3d&)>& visit);

/// Calls visit() for every map, but for those before the first fused frame (stamp 0), and those older than
/// one before them; of several with one stamp it is the last.
InputAccount for_each_map(const std::filesystem::path& path,
                          const std::function<void(const LocalMap&)>& visit);

}  // namespace laneloom
