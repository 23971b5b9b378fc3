#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "export/drive_lines.hpp"
#include "export/drive_stations.hpp"
#include "laneloom/types.hpp"

/// How drives and parts of them are moved. Transforms lead from the frame of a drive's poses to that of a
/// road.
namespace laneloom::exports {

using Motion = Eigen::Vector4d;  ///< x, y, z in metres and yaw in radians, about a place

inline Eigen::Vector2d left_of(const Eigen::Vector2d& along) { return {-along.y(), along.x()}; }

/// `T` turned and moved about a place of the road.
Eigen::Isometry3d moved(const Eigen::Isometry3d& T, const Motion& by, const Point& about);

/// The motion about a place of the road that leads from one transform to another.
Motion motion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, const Point& about);

/// The transforms for the poses of a drive, between those of its stations.
std::vector<Eigen::Isometry3d> between(const std::vector<DriveStation>& stations,
                                       const std::vector<Eigen::Isometry3d>& T_road_drive,
                                       const DriveLines& drive);

/// Moves the lines and the poses of a drive. `T_road_drive` is per pose.
void move(const std::vector<Eigen::Isometry3d>& T_road_drive, DriveLines& drive);
/// Likewise, all of a drive alike.
void move(const Eigen::Isometry3d& T_road_drive, DriveLines& drive);

}  // namespace laneloom::exports
