#pragma once

#include <filesystem>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// Reads poses T_map_body from a table with the columns that Argoverse 2 has: timestamp_ns, qw, qx, qy, qz,
/// tx_m, ty_m, tz_m. The file is a Feather file where it is called .feather (io/feather.hpp); else it has
/// comma-separated values, these columns first, below a line of their names. Poses come as cleaned_poses()
/// makes them. Throws std::runtime_error naming file and place, also where fewer than two poses are left.
std::vector<VehiclePose> read_pose_table(const std::filesystem::path& path);

/// In ascending stamp order, with the first one alone of those that are less than 1 ms apart: logs have
/// several poses of one moment, which would look like standstills or jumps.
std::vector<VehiclePose> cleaned_poses(std::vector<VehiclePose> poses);

}  // namespace laneloom
