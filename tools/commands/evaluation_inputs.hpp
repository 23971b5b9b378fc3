#pragma once

#include <filesystem>
#include <functional>

#include "laneloom/types.hpp"

/// What is evaluated, from files of either kind: JSON lines (io/json_lines.hpp) or a recording
/// (laneloom/recording.hpp), told apart by their first bytes. Both throw std::runtime_error naming the file
/// and the place in it where it cannot be read or is malformed.
namespace laneloom {

/// Calls visit() for every frame with T_map_body at its stamp. Of a recording, these are the frames and poses
/// that a service would believe, in the order of their stamps; those without poses around them are left out.
void for_each_frame(const std::filesystem::path& path,
                    const std::function<void(const DetectionFrame&, const Eigen::Isometry3d&)>& visit);

/// Calls visit() for every map. Of a recording, these are the published lane maps, but for those before the
/// first fused frame (stamp 0), and those older than one before them; of several with one stamp it is the
/// last.
void for_each_map(const std::filesystem::path& path, const std::function<void(const LocalMap&)>& visit);

}  // namespace laneloom
