#pragma once

#include <string>
#include <utility>
#include <vector>

#include "laneloom/mapper.hpp"
#include "mapping/shapes.hpp"

/// A road, and a vehicle that maps it, frame by frame.
namespace laneloom::test {

inline constexpr double kStep_m = 1.0;  // 10 m/s at 10 Hz

/// A road along x with two lanes of 3.6 m between voxel centres, a dashed line between them, and a stopline
/// at x = 60.
inline std::vector<Detection> road() {
  return {detection(MarkingType::roadedge, straight({-50, 3.7, 0.1}, {300, 3.7, 0.1}), MarkingStyle::solid),
          detection(MarkingType::laneline, straight({-50, 0.1, 0.1}, {300, 0.1, 0.1}), MarkingStyle::dashed),
          detection(MarkingType::roadedge, straight({-50, -3.5, 0.1}, {300, -3.5, 0.1}), MarkingStyle::solid),
          detection(MarkingType::stopline, straight({60, -3.5, 0.1}, {60, 0.1, 0.1}))};
}

inline DetectionFrame frame_at(double x, std::vector<Detection> in_map, int number) {
  DetectionFrame frame;
  frame.stamp_ns = number * 100'000'000LL;
  frame.sequence = static_cast<std::uint64_t>(number);
  for (Detection& d : in_map) {
    for (Point& p : d.points) p = at(x).inverse() * p;
  }
  frame.detections = std::move(in_map);
  return frame;
}

inline MapperConfig with_method(const std::string& method) {
  MapperConfig config;
  config.method = method == "voxels" ? FusionMethod::voxels : FusionMethod::lines;
  return config;
}

class Drive {
 public:
  explicit Drive(const std::string& method = "lines") : Drive(with_method(method)) {}
  explicit Drive(const MapperConfig& config, SdMap sd_map = {}) : mapper(config, std::move(sd_map)) {}
  const LocalMap& step(const std::vector<Detection>& detections = road(), StageObserver* observer = nullptr) {
    x += kStep_m;
    return mapper.update(frame_at(x, detections, ++number), at(x), observer);
  }
  const LocalMap& steps(int count) {
    for (int i = 0; i < count; ++i) step();
    return mapper.map();
  }
  Mapper mapper;
  double x = 0.0;
  int number = 0;
};

/// The ids of the lanelines of a map.
inline std::vector<ElementId> lanelines(const Drive& drive) {
  std::vector<ElementId> ids;
  for (const Marking& marking : drive.mapper.map().markings)
    if (marking.type == MarkingType::laneline) ids.push_back(marking.id);
  return ids;
}

}  // namespace laneloom::test
