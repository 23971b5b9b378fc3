#include "import/streammapnet.hpp"

#include <array>
#include <numbers>
#include <string>

#include "io/json_fields.hpp"
#include "io/json_stream.hpp"

namespace laneloom::imports {
namespace {

using nlohmann::json;

constexpr std::array kClasses{"ped_crossing", "divider", "boundary"};  // by label

std::string class_of(const json& value) {
  const std::uint64_t label = io::count(value);
  if (label >= kClasses.size()) throw io::JsonError("must be 0, 1 or 2");
  return kClasses[label];
}

void read_sample(const std::string& token, const json& sample, FrameCollector& frames) {
  if (!frames.begin(token)) return;
  const auto scores =
      io::required(sample, "scores", [](const json& values) { return io::list(values, confidence); });
  const auto classes =
      io::required(sample, "labels", [](const json& values) { return io::list(values, class_of); });
  std::size_t next = 0;
  io::required(sample, "vectors", [&](const json& vectors) {
    if (!vectors.is_array() || vectors.size() != scores.size() || vectors.size() != classes.size())
      throw io::JsonError("must be as many as scores and labels");
    return io::list(vectors, [&](const json& points) {
      frames.add(classes[next], scores[next], points);
      return ++next;
    });
  });
  frames.end();
}

/// Takes points of a network to the frame of points of a drive. About the LiDAR of nuScenes, MapTracker's
/// points are x forward, y left, but those of a drive are x right, y forward, as MapTR's. In other drives
/// both are in the vehicle's frame.
Eigen::Isometry3d T_drive_points(const DriveLog& drive, StreamNetwork network) {
  if (!drive.points_about_lidar) return Eigen::Isometry3d::Identity();
  if (network == StreamNetwork::streammapnet) return drive.T_body_points.inverse();
  return Eigen::Isometry3d(Eigen::AngleAxisd(0.5 * std::numbers::pi, Point::UnitZ()));
}

}  // namespace

ImportedFrames read_streammapnet(const std::filesystem::path& path, const DriveLog& drive,
                                 StreamNetwork network) {
  const char* const source = network == StreamNetwork::streammapnet ? "streammapnet" : "maptracker";
  FrameCollector frames(drive, source, T_drive_points(drive, network));
  io::for_each_json_member(path, "results", [&](const std::string& token, const json& sample) {
    read_sample(token, sample, frames);
  });
  return std::move(frames).finish(path.string());
}

}  // namespace laneloom::imports
