#include "simulation/pose_table.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/unit_rotation.hpp"
#include "io/csv.hpp"
#include "io/feather.hpp"

namespace laneloom::simulation {
namespace {

constexpr std::int64_t kSamePose_ns = 1'000'000;

std::vector<VehiclePose> read_csv(const std::filesystem::path& path, LeftOut& left_out) {
  std::vector<VehiclePose> poses;
  io::for_each_csv_row(path, "timestamp_ns,qw,qx,qy,qz,tx_m,ty_m,tz_m", left_out, [&](std::string_view row) {
    const auto stamp_ns = io::take_number<std::int64_t>(row);
    PoseNumbers numbers{};
    for (double& number : numbers) number = io::take_number<double>(row);
    poses.push_back(checked_pose(stamp_ns, numbers));
  });
  return poses;
}

std::vector<VehiclePose> read_feather(const std::filesystem::path& path, LeftOut& left_out) {
  const io::FeatherTable table(path);
  const std::vector<std::int64_t> stamps_ns = table.column<std::int64_t>("timestamp_ns");
  std::vector<std::vector<double>> columns;
  columns.reserve(kPoseColumns.size());
  for (const char* name : kPoseColumns) columns.push_back(table.column<double>(name));
  std::vector<VehiclePose> poses;
  for (std::size_t row = 0; row < stamps_ns.size(); ++row) {
    PoseNumbers numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = columns[i][row];
    try {
      poses.push_back(checked_pose(stamps_ns[row], numbers));
    } catch (const std::runtime_error& error) {
      const std::string place = ": row " + std::to_string(row);
      if (left_out.strict()) throw std::runtime_error(path.string() + place + ": " + error.what());
      left_out.add(error.what(), path.filename().string() + place);
    }
  }
  return poses;
}

}  // namespace

VehiclePose checked_pose(std::int64_t stamp_ns, const PoseNumbers& v) {
  if (stamp_ns < 0) throw std::runtime_error("a stamp of 0 or more is expected");
  const Eigen::Quaterniond q(v[0], v[1], v[2], v[3]);
  if (!is_unit(q)) throw std::runtime_error("a quaternion of unit length is expected");
  VehiclePose pose{.stamp_ns = stamp_ns, .position = {v[4], v[5], v[6]}, .orientation = q.normalized()};
  if (!pose.position.allFinite()) throw std::runtime_error("a finite number is expected");
  return pose;
}

std::vector<VehiclePose> read_pose_table(const std::filesystem::path& path, LeftOut& left_out) {
  const std::vector<VehiclePose> given =
      path.extension() == ".feather" ? read_feather(path, left_out) : read_csv(path, left_out);
  std::vector<VehiclePose> poses = cleaned_poses(given);
  if (poses.size() < 2)
    throw std::runtime_error(
        path.string() + ": has fewer than two poses" +
        (given.size() < 2 ? "" : " that are a millisecond apart; stamps are nanoseconds"));
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

}  // namespace laneloom::simulation
