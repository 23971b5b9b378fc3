#include "simulation/pose_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "io/csv.hpp"

namespace laneloom {
namespace {

constexpr std::int64_t kSamePose_ns = 1'000'000;

VehiclePose read_pose(std::string_view row) {
  VehiclePose pose;
  pose.stamp_ns = take_number<std::int64_t>(row);
  if (pose.stamp_ns < 0) throw std::runtime_error("a stamp of 0 or more is expected");
  std::array<double, 7> v{};
  for (double& value : v) value = take_number<double>(row);
  const Eigen::Quaterniond q(v[0], v[1], v[2], v[3]);
  if (!(std::abs(q.norm() - 1.0) < 1e-3)) throw std::runtime_error("a quaternion of unit length is expected");
  pose.orientation = q.normalized();
  pose.position = {v[4], v[5], v[6]};
  return pose;
}

}  // namespace

std::vector<VehiclePose> read_pose_csv(const std::filesystem::path& path) {
  std::vector<VehiclePose> poses;
  for_each_csv_row(path, "timestamp_ns,qw,qx,qy,qz,tx_m,ty_m,tz_m",
                   [&](std::string_view row) { poses.push_back(read_pose(row)); });
  poses = cleaned_poses(std::move(poses));
  if (poses.size() < 2) throw std::runtime_error(path.string() + ": has fewer than two poses");
  return poses;
}

std::vector<VehiclePose> cleaned_poses(std::vector<VehiclePose> poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const VehiclePose& a, const VehiclePose& b) { return a.stamp_ns < b.stamp_ns; });
  const auto same = [](const VehiclePose& a, const VehiclePose& b) {
    return b.stamp_ns - a.stamp_ns < kSamePose_ns;
  };
  poses.erase(std::unique(poses.begin(), poses.end(), same), poses.end());
  return poses;
}

}  // namespace laneloom
