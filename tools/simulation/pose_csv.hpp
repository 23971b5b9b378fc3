#pragma once

#include <filesystem>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// Reads poses T_map_body from a table with a line of column names, as Argoverse 2 has it: timestamp_ns, qw,
/// qx, qy, qz, tx_m, ty_m, tz_m. They come as cleaned_poses() makes them.
/// Throws std::runtime_error naming file and line, also where fewer than two poses are left.
std::vector<VehiclePose> read_pose_csv(const std::filesystem::path& path);

/// In ascending stamp order, with the first one alone of those that are less than 1 ms apart: logs have
/// several poses of one moment, which would look like standstills or jumps.
std::vector<VehiclePose> cleaned_poses(std::vector<VehiclePose> poses);

}  // namespace laneloom
