// map_bits FRAMES: maps the frames of a file of JSON lines (tools/README.md), and prints a hash of all that
// the mapper knows after each of them. It needs the mapper alone, so that it can be built for another
// processor.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "laneloom/element_names.hpp"
#include "laneloom/mapper.hpp"

namespace laneloom {
namespace {

using Json = nlohmann::json;

Polyline points_of(const Json& points) {
  Polyline line;
  for (const Json& point : points) line.emplace_back(point[0], point[1], point[2]);
  return line;
}

template <class Enumeration>
Enumeration of_name(const std::string& wanted, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (name(static_cast<Enumeration>(i)) == wanted) return static_cast<Enumeration>(i);
  throw std::runtime_error("unknown: " + wanted);
}

Detection detection_of(const Json& json) {
  return {.type = of_name<MarkingType>(json.at("type"), kMarkingTypeCount),
          .style = of_name<MarkingStyle>(json.value("style", "unknown"), kMarkingStyleCount),
          .confidence = json.at("score"),
          .points = points_of(json.at("points")),
          .stddev_m = {}};
}

DetectionFrame frame_of(const Json& json) {
  DetectionFrame frame{.stamp_ns = json.at("stamp_ns"), .source = json.value("source", "")};
  frame.field_of_view = points_of(json.value("field_of_view", Json::array()));
  for (const Json& area : json.value("occluded_areas", Json::array()))
    frame.occluded_areas.push_back(points_of(area));
  for (const Json& detection : json.at("detections")) frame.detections.push_back(detection_of(detection));
  return frame;
}

Eigen::Isometry3d pose_of(const Json& pose) {
  return Eigen::Translation3d(pose[0], pose[1], pose[2]) *
         Eigen::Quaterniond(pose[6], pose[3], pose[4], pose[5]).normalized();
}

/// FNV-1a.
void mix(const std::string& bytes, std::uint64_t& hash) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
}

void run(const std::string& file) {
  std::ifstream in(file);
  Mapper mapper{MapperConfig{}};
  std::uint64_t hash = 0xcbf29ce484222325U;
  int frames = 0;
  for (std::string line; std::getline(in, line); ++frames) {
    const Json json = Json::parse(line);
    mapper.update(frame_of(json), pose_of(json.at("pose")));
    mix(mapper.save(), hash);
  }
  if (frames == 0) throw std::runtime_error(file + ": no frames");
  std::printf("%d frames %016llx\n", frames, static_cast<unsigned long long>(hash));
}

}  // namespace
}  // namespace laneloom

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: map_bits FRAMES");
  laneloom::run(argv[1]);
} catch (const std::exception& error) {
  std::fprintf(stderr, "map_bits: %s\n", error.what());
  return 1;
}
