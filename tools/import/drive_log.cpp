#include "import/drive_log.hpp"

#include <charconv>
#include <map>
#include <stdexcept>
#include <string_view>

#include "io/csv.hpp"
#include "simulation/argoverse2.hpp"
#include "simulation/pose_table.hpp"

namespace laneloom::imports {
namespace {

constexpr double kArgoverse2Ground_m = -0.33;

/// The number that a text is. None: it is no number.
std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t number = 0;
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && last == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Names the samples of a log of Argoverse 2.
struct Argoverse2Samples {
  std::string log_id;
  std::int64_t first_ns, last_ns;  ///< stamps of its first and last pose

  std::optional<std::int64_t> operator()(const std::string& token) const {
    const std::string prefix = log_id + "_";
    if (const auto stamp_ns = whole_number(token))
      return *stamp_ns >= first_ns && *stamp_ns <= last_ns ? stamp_ns : std::nullopt;
    if (!token.starts_with(prefix)) return std::nullopt;
    const auto stamp_ns = whole_number(std::string_view(token).substr(prefix.size()));
    if (!stamp_ns) throw std::runtime_error("the sample " + token + " is not named <log id>_<stamp in ns>");
    return stamp_ns;
  }
};

}  // namespace

DriveLog argoverse2_drive(const std::filesystem::path& log_directory, LeftOut& left_out) {
  const std::filesystem::path whole = std::filesystem::weakly_canonical(log_directory);
  const std::string log_id = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  DriveLog drive{.name = log_id,
                 .poses = simulation::argoverse2_poses(log_directory, left_out),
                 .ground_z_m = kArgoverse2Ground_m};
  drive.stamp_ns_of = Argoverse2Samples{log_id, drive.poses.front().stamp_ns, drive.poses.back().stamp_ns};
  return drive;
}

DriveLog plain_drive(const std::filesystem::path& poses, const std::filesystem::path& samples,
                     const Eigen::Matrix3d& axes, LeftOut& left_out) {
  std::map<std::string, std::int64_t> stamps;
  io::for_each_csv_row(samples, "token,timestamp_ns", left_out, [&](std::string_view row) {
    const std::string token(io::take_field(row));
    if (!stamps.emplace(token, io::take_number<std::int64_t>(row)).second)
      throw std::runtime_error("a sample that is given twice");
  });
  DriveLog drive{.name = poses.string() + " and " + samples.string(),
                 .poses = simulation::read_pose_table(poses, left_out)};
  drive.stamp_ns_of = [stamps = std::move(stamps)](const std::string& token) -> std::optional<std::int64_t> {
    const auto found = stamps.find(token);
    return found == stamps.end() ? std::nullopt : std::optional(found->second);
  };
  drive.T_body_points.linear() = axes;
  return drive;
}

}  // namespace laneloom::imports
