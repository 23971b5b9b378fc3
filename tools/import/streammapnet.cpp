#include "import/streammapnet.hpp"

#include <array>
#include <numbers>
#include <string>

#include "io/json_fields.hpp"
#include "io/json_stream.hpp"

namespace laneloom::imports {
namespace {

using nlohmann::json;

constexpr std::array kClasses{"ped_crossing", "divider", "boundary"};  // by label; others have no name

std::string class_of(const json& value) {
  const std::uint64_t label = io::count(value);
  return label < kClasses.size() ? kClasses[label] : std::to_string(label);
}

void read_sample(const std::string& token, const json& sample, FrameCollector& frames) {
  if (!frames.begin(token)) return;
  const json& scores = *io::required(sample, "scores", io::array);
  const json& labels = *io::required(sample, "labels", io::array);
  const json& vectors = *io::required(sample, "vectors", io::array);
  // None of them is known to be another's.
  if (vectors.size() != scores.size() || vectors.size() != labels.size())
    throw io::JsonError("vectors", "must be as many as scores and labels");
  for (std::size_t i = 0; i < vectors.size(); ++i)
    frames.add_line(i, [&] { frames.add(class_of(labels[i]), confidence(scores[i]), vectors[i]); });
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

ImportedFrames read_streammapnet(const std::filesystem::path& path, StreamNetwork network,
                                 const ResultsReading& reading) {
  const char* const source = network == StreamNetwork::streammapnet ? "streammapnet" : "maptracker";
  FrameCollector frames(reading, source, T_drive_points(reading.drive, network));
  return std::move(frames).collect(path, [&] {
    const auto take = [&](const std::string& token, const json& sample) {
      frames.add_sample("results." + token, [&] { read_sample(token, sample, frames); });
    };
    io::for_each_json_member(path, "results", take, reading.on_step);
  });
}

}  // namespace laneloom::imports
