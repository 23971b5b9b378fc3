#include "export/survey.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/degree.hpp"
#include "export/align.hpp"
#include "export/driven_over.hpp"
#include "export/loops.hpp"
#include "export/motions.hpp"

namespace laneloom::exports {
namespace {

constexpr double kPlace_m = 4.0;
constexpr int kHeadings = 8;
constexpr int kEnoughWays = 3;  // more drives along one way tell nothing new of its lanes

std::array<int, 3> way_key(const Eigen::Isometry3d& pose) {
  const double heading = std::atan2(pose(1, 0), pose(0, 0)) / (2.0 * std::numbers::pi);
  return {static_cast<int>(std::floor(pose.translation().x() / kPlace_m)),
          static_cast<int>(std::floor(pose.translation().y() / kPlace_m)),
          static_cast<int>(std::floor((heading + 0.5) * kHeadings)) % kHeadings};
}

Survey::Offset offset_of(const std::vector<Eigen::Isometry3d>& poses,
                         const std::vector<Eigen::Isometry3d>& T_road_drive) {
  Survey::Offset offset;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Point place = poses[i].translation();
    const double offset_m = (T_road_drive[i] * place - place).head<2>().norm();
    offset.mean_m += offset_m / static_cast<double>(poses.size());
    offset.greatest_m = std::max(offset.greatest_m, offset_m);
    const double yaw = std::atan2(T_road_drive[i](1, 0), T_road_drive[i](0, 0));
    offset.greatest_deg = std::max(offset.greatest_deg, std::abs(yaw) / kDegree);
  }
  return offset;
}

}  // namespace

Survey::Offset Survey::add(DriveLines drive) {
  const std::vector<Eigen::Isometry3d> T_closed_drive = close_loops(drive);
  const double loops_m = offset_of(drive.poses, T_closed_drive).greatest_m;
  move(T_closed_drive, drive);
  const std::vector<Eigen::Isometry3d> T_road_drive = align(drive, archive_);
  Offset offset = offset_of(drive.poses, T_road_drive);
  offset.loops_m = loops_m;
  move(T_road_drive, drive);
  offset.met_share = met_share(drive.pieces, archive_);
  std::uint64_t last_pass = 0;
  for (ArchivedPiece& piece : drive.pieces) {
    last_pass = piece.pass;
    piece.pass += passes_;
    archive_.add(piece);
  }
  passes_ += last_pass + 1;
  archive_.end_drive(drive.poses);
  keep_way(drive.poses);
  return offset;
}

void Survey::keep_way(const std::vector<Eigen::Isometry3d>& poses) {
  std::map<std::array<int, 3>, int> now;
  for (const Eigen::Isometry3d& pose : poses) {
    const auto key = way_key(pose);
    const auto known = ways_.find(key);
    if (known != ways_.end() && known->second >= kEnoughWays) continue;
    poses_.push_back(pose);
    now[key] = 1;
  }
  for (const auto& [key, one] : now) ways_[key] += one;
}

SurveyedRoad Survey::road() const { return {without_edges_driven_over(archive_.markings(), poses_), poses_}; }

}  // namespace laneloom::exports
