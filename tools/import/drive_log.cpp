#include "import/drive_log.hpp"

#include <charconv>
#include <map>
#include <stdexcept>

#include "io/csv.hpp"
#include "simulation/argoverse2.hpp"
#include "simulation/pose_table.hpp"

namespace laneloom {
namespace {

constexpr double kArgoverse2Ground_m = -0.33;

std::optional<std::int64_t> argoverse2_stamp_ns(const std::string& log_id, const std::string& token) {
  const std::string prefix = log_id + "_";
  if (!token.starts_with(prefix)) return std::nullopt;
  std::int64_t stamp_ns = 0;
  const char* const end = token.data() + token.size();
  const auto [last, error] = std::from_chars(token.data() + prefix.size(), end, stamp_ns);
  if (error != std::errc() || last != end)
    throw std::runtime_error("the sample " + token + " is not named <log id>_<stamp in ns>");
  return stamp_ns;
}

/// The rotation that takes x right, y forward to x forward, y left.
Eigen::Isometry3d from_right_forward() {
  Eigen::Isometry3d rotation = Eigen::Isometry3d::Identity();
  rotation.linear() << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  return rotation;
}

}  // namespace

DriveLog argoverse2_drive(const std::filesystem::path& log_directory) {
  const std::filesystem::path whole = std::filesystem::weakly_canonical(log_directory);
  const std::string log_id = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  return {.name = log_id,
          .poses = argoverse2_poses(log_directory),
          .stamp_ns_of = [log_id](const std::string& token) { return argoverse2_stamp_ns(log_id, token); },
          .ground_z_m = kArgoverse2Ground_m};
}

DriveLog plain_drive(const std::filesystem::path& poses, const std::filesystem::path& samples,
                     PointAxes axes) {
  std::map<std::string, std::int64_t> stamps;
  for_each_csv_row(samples, "token,timestamp_ns", [&](std::string_view row) {
    const std::string token(take_field(row));
    if (!stamps.emplace(token, take_number<std::int64_t>(row)).second)
      throw std::runtime_error("the sample " + token + " is given twice");
  });
  DriveLog drive{.name = samples.string(), .poses = read_pose_table(poses)};
  drive.stamp_ns_of = [stamps = std::move(stamps)](const std::string& token) -> std::optional<std::int64_t> {
    const auto found = stamps.find(token);
    return found == stamps.end() ? std::nullopt : std::optional(found->second);
  };
  if (axes == PointAxes::right_forward) drive.T_body_points = from_right_forward();
  return drive;
}

}  // namespace laneloom
