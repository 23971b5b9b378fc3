#include "export/motions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace laneloom::exports {
namespace {

double yaw_of(const Eigen::Isometry3d& T) { return std::atan2(T(1, 0), T(0, 0)); }

}  // namespace

Eigen::Isometry3d moved(const Eigen::Isometry3d& T, const Motion& by, const Point& about) {
  return Eigen::Translation3d(about + by.head<3>()) * Eigen::AngleAxisd(by[3], Point::UnitZ()) *
         Eigen::Translation3d(-about) * T;
}

Motion motion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, const Point& about) {
  const Eigen::Isometry3d step = to * from.inverse();
  Motion by;
  by << step * about - about, yaw_of(step);
  return by;
}

std::vector<Eigen::Isometry3d> between(const std::vector<DriveStation>& stations,
                                       const std::vector<Eigen::Isometry3d>& T_road_drive,
                                       const DriveLines& drive) {
  std::vector<Eigen::Isometry3d> result;
  const std::vector<double> driven_m = driven_to(drive);
  std::size_t k = 0;
  for (std::size_t i = 0; i < drive.poses.size(); ++i) {
    while (k + 2 < stations.size() && stations[k + 1].driven_m < driven_m[i]) ++k;
    const std::size_t next = std::min(k + 1, stations.size() - 1);
    const double length_m = stations[next].driven_m - stations[k].driven_m;
    const double share =
        length_m > 0.0 ? std::clamp((driven_m[i] - stations[k].driven_m) / length_m, 0.0, 1.0) : 0.0;
    const Point about = T_road_drive[k] * Point(drive.poses[i].translation());
    result.push_back(
        moved(T_road_drive[k], share * motion(T_road_drive[k], T_road_drive[next], about), about));
  }
  return result;
}

void move(const std::vector<Eigen::Isometry3d>& T_road_drive, DriveLines& drive) {
  for (ArchivedPiece& piece : drive.pieces)
    for (Point& point : piece.marking.points) point = T_road_drive[piece.pose] * point;
  for (std::size_t i = 0; i < drive.poses.size(); ++i) drive.poses[i] = T_road_drive[i] * drive.poses[i];
}

void move(const Eigen::Isometry3d& T_road_drive, DriveLines& drive) {
  move(std::vector<Eigen::Isometry3d>(drive.poses.size(), T_road_drive), drive);
}

}  // namespace laneloom::exports
