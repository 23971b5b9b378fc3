#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/left_out.hpp"
#include "laneloom/types.hpp"

namespace laneloom::imports {

/// One drive of a data set. It has the data that the results of a network lack.
struct DriveLog {
  std::string name;
  std::vector<VehiclePose> poses;  ///< stamps ascend
  /// The stamp of a sample. None: the sample belongs to another drive.
  std::function<std::optional<std::int64_t>(const std::string& sample_token)> stamp_ns_of;
  /// Takes the points of the results to the body frame.
  Eigen::Isometry3d T_body_points = Eigen::Isometry3d::Identity();
  /// The points are about the LiDAR, as nuScenes' in MapTR; else about the vehicle.
  bool points_about_lidar = false;
  double ground_z_m = 0.0;  ///< of the road in the body frame: the height of points without one
};

/// The drive of a log of Argoverse 2 (its directory, named by the log's id). Samples are called `<log
/// id>_<stamp in ns>`, or by the stamp alone: then a sample belongs to this log if it lies between the log's
/// poses. Points are in the vehicle's frame.
DriveLog argoverse2_drive(const std::filesystem::path& log_directory, LeftOut& left_out);

/// The drive of a scene of nuScenes, from the folder of tables (v1.0-…). Points are in a level frame at the
/// LiDAR: x right, y forward. It is turned by the LiDAR's yaw alone, and the road is at z = 0. Records that
/// are wrong are left out. Throws std::runtime_error naming the table and what it lacks, and of the first
/// such record if `left_out` is strict.
DriveLog nuscenes_drive(const std::filesystem::path& tables, const std::string& scene, LeftOut& left_out);

/// A drive of any other data set, from poses as read_pose_table() reads them, and a table of samples with the
/// columns token and timestamp_ns. Points are in the vehicle's frame, with other axes: see io/axes.hpp. Rows
/// that are wrong, and samples that come twice, are left out.
DriveLog plain_drive(const std::filesystem::path& poses, const std::filesystem::path& samples,
                     const Eigen::Matrix3d& axes, LeftOut& left_out);

}  // namespace laneloom::imports
