#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "import/drive_log.hpp"
#include "io/json_fields.hpp"
#include "io/json_stream.hpp"
#include "simulation/pose_table.hpp"

namespace laneloom::imports {
namespace {

using nlohmann::json;
using Tokens = std::set<std::string>;

std::string token(const json& record) { return io::required(record, "token", io::text); }

std::int64_t stamp_ns(const json& record) {
  const std::int64_t stamp_us = io::required(record, "timestamp", io::integer);
  if (stamp_us < 0 || stamp_us > INT64_MAX / 1000)
    throw io::JsonError("timestamp", "must be microseconds since 1970");
  return stamp_us * 1000;
}

Point translation(const json& record) { return io::required(record, "translation", io::point); }

/// Reads "rotation", which has w first.
Eigen::Quaterniond rotation(const json& record) {
  return io::required(record, "rotation", [](const json& value) {
    if (!value.is_array() || value.size() != 4) throw io::JsonError("must be [w, x, y, z]");
    return io::quaternion(json{value[1], value[2], value[3], value[0]}, 0);
  });
}

/// Reads the tables of one scene. Large tables, which hold every scene, are read record by record. Records
/// that are wrong are left out.
class SceneReader {
 public:
  SceneReader(std::filesystem::path tables, std::string scene, LeftOut& left_out)
      : tables_(std::move(tables)), scene_(std::move(scene)), left_out_(left_out) {}

  DriveLog read() {
    const std::string scene = scene_token();
    for_each("sample", [&](const json& record) {
      if (io::required(record, "scene_token", io::text) == scene) samples_.insert(token(record));
    });
    read_lidars();
    for_each("sample_data", [&](const json& record) { read_sample_data(record); });
    DriveLog drive{
        .name = scene_, .poses = poses(), .T_body_points = T_body_points(), .points_about_lidar = true};
    drive.stamp_ns_of = [stamps = std::move(stamps_)](const std::string& sample) {
      const auto found = stamps.find(sample);
      return found == stamps.end() ? std::nullopt : std::optional(found->second);
    };
    return drive;
  }

 private:
  void for_each(const std::string& table, const std::function<void(const json&)>& visit) const {
    std::size_t number = 0;
    io::for_each_json_element(path(table), "", [&](const json& record) {
      const std::string place = table + ".json[" + std::to_string(number++) + "]";
      io::take_or_leave_out(left_out_, place, "", [&] { visit(record); });
    });
  }
  std::filesystem::path path(const std::string& table) const { return tables_ / (table + ".json"); }

  std::string scene_token() const {
    std::optional<std::string> found;
    for_each("scene", [&](const json& record) {
      if (io::required(record, "name", io::text) == scene_) found = token(record);
    });
    if (!found) throw std::runtime_error(path("scene").string() + ": has no scene " + scene_);
    return *found;
  }

  void read_lidars() {
    Tokens sensors;
    for_each("sensor", [&](const json& record) {
      if (io::required(record, "channel", io::text) == "LIDAR_TOP") sensors.insert(token(record));
    });
    for_each("calibrated_sensor", [&](const json& record) {
      if (!sensors.contains(io::required(record, "sensor_token", io::text))) return;
      lidars_[token(record)] = Eigen::Translation3d(translation(record)) * rotation(record);
    });
  }

  /// Reads a record of a sensor's data. Each has a pose. The stamp of a sample is that of its LiDAR's sweep.
  void read_sample_data(const json& record) {
    const auto sample = io::required(record, "sample_token", io::text);
    if (!samples_.contains(sample)) return;
    pose_tokens_.insert(io::required(record, "ego_pose_token", io::text));
    const auto lidar = lidars_.find(io::required(record, "calibrated_sensor_token", io::text));
    if (lidar == lidars_.end() || !io::required(record, "is_key_frame", io::boolean)) return;
    stamps_[sample] = stamp_ns(record);
    T_body_lidar_ = lidar->second;  // the same in the whole scene
  }

  std::vector<VehiclePose> poses() const {
    std::vector<VehiclePose> poses;
    for_each("ego_pose", [&](const json& record) {
      if (!pose_tokens_.contains(token(record))) return;
      poses.push_back(
          {.stamp_ns = stamp_ns(record), .position = translation(record), .orientation = rotation(record)});
    });
    poses = simulation::cleaned_poses(std::move(poses));
    if (poses.size() < 2)
      throw std::runtime_error(path("ego_pose").string() + ": has fewer than two poses of " + scene_);
    return poses;
  }

  Eigen::Isometry3d T_body_points() const {
    if (!T_body_lidar_)
      throw std::runtime_error(path("sample_data").string() + ": has no LIDAR_TOP of " + scene_);
    const Point x_axis = T_body_lidar_->linear().col(0);
    return Eigen::Translation3d(T_body_lidar_->translation()) *
           Eigen::AngleAxisd(std::atan2(x_axis.y(), x_axis.x()), Point::UnitZ());
  }

  std::filesystem::path tables_;
  std::string scene_;
  LeftOut& left_out_;
  Tokens samples_, pose_tokens_;
  std::map<std::string, Eigen::Isometry3d> lidars_;  ///< T_body_lidar by token of the calibrated sensor
  std::map<std::string, std::int64_t> stamps_;       ///< by sample
  std::optional<Eigen::Isometry3d> T_body_lidar_;
};

}  // namespace

DriveLog nuscenes_drive(const std::filesystem::path& tables, const std::string& scene, LeftOut& left_out) {
  return SceneReader(tables, scene, left_out).read();
}

}  // namespace laneloom::imports
