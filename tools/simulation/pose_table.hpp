#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/left_out.hpp"
#include "laneloom/types.hpp"

namespace laneloom::simulation {

/// The columns qw, qx, qy, qz, tx_m, ty_m, tz_m of a row of Argoverse 2.
using PoseNumbers = std::array<double, 7>;
inline constexpr std::array kPoseColumns{"qw", "qx", "qy", "qz", "tx_m", "ty_m", "tz_m"};
/// The pose in a row. Throws std::runtime_error where it is none.
VehiclePose checked_pose(std::int64_t stamp_ns, const PoseNumbers& numbers);

/// Reads poses T_map_body from a table with the columns of Argoverse 2: timestamp_ns, qw, qx, qy, qz, tx_m,
/// ty_m, tz_m. A file called .feather is a Feather file (io/feather.hpp). Any other has comma-separated
/// values, these columns first, below a line of their names. The poses are passed through cleaned_poses().
/// Rows that are no poses are left out. Throws std::runtime_error naming the file if it is no such table, or
/// fewer than two poses are left; also naming the first such row if `left_out` is strict.
std::vector<VehiclePose> read_pose_table(const std::filesystem::path& path, LeftOut& left_out);

/// The poses in ascending order of stamps. Of poses that are less than 1 ms apart, only the first is kept:
/// logs have several poses of one moment, which would look like standstills or jumps.
std::vector<VehiclePose> cleaned_poses(std::vector<VehiclePose> poses);

}  // namespace laneloom::simulation
