#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "export/drive_lines.hpp"
#include "export/line_archive.hpp"

namespace laneloom::exports {

/// Finds, for each pose of a drive, the transform T_road_drive: how the drive has to be moved there so that
/// its lines lie on those of a road. Poses of different days are metres apart, and odometry drifts. Every 10
/// m, the lines that the drive left behind since then are laid upon the nearest lines of the road (point to
/// line, by Gauss-Newton), from where a Kalman filter expects them; it estimates the drift as well. A
/// Rauch-Tung-Striebel smoother then carries what was found back. Where the road is not known yet, the filter
/// goes on alone, and soon as the poses say: a drift that was found on a short stretch would bend the rest.
/// At the beginning, and where nothing has held the drive for long, places up to 6 m around are tried, and
/// headings up to 1.5 degrees. A drive that finds no road stays where its poses say. Ours, beyond the paper.
std::vector<Eigen::Isometry3d> align(const DriveLines& drive, const LineArchive& road);

/// The place of a drive's end on a road. The covariance is of x, y, z (m) and yaw (rad) about the vehicle's
/// last place.
struct EndOnRoad {
  Eigen::Isometry3d T_road_drive = Eigen::Isometry3d::Identity();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();
};

/// Likewise, for the end of a drive alone. `stddev_m` is that of the drive's first place; from 0.8 on, the
/// places around are tried. Empty: its last lines do not lie on the road.
std::optional<EndOnRoad> end_on_road(const DriveLines& drive, const LineArchive& road, double stddev_m);

/// The share of a drive's lines that lie on lines of a road.
double met_share(const std::vector<ArchivedPiece>& pieces, const LineArchive& road);

}  // namespace laneloom::exports
