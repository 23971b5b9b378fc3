#include "config/network_profile.hpp"

#include <cmath>

#include "laneloom/mapper.hpp"
#include "memory_file.hpp"

namespace {

using namespace laneloom;

DetectionFrame frame_of_two_lines(const std::string& source, std::int64_t stamp_ns) {
  DetectionFrame frame{.stamp_ns = stamp_ns, .source = source};
  for (const double y_m : {-1.75, 1.75})
    frame.detections.push_back(
        Detection{.confidence = 0.9, .points = {{-5.0, y_m, 0.0}, {20.0, y_m, 0.0}, {60.0, y_m, 0.0}}});
  return frame;
}

/// Whether what is learned from then on, and the map, are numbers.
void check(const Mapper& mapper) {
  for (const auto& [source, profile] : mapper.profiles())
    for (const auto& [name, learned] : profile)
      if (!std::isfinite(learned.value) || !std::isfinite(learned.weight)) __builtin_trap();
  for (const Marking& marking : mapper.map().markings)
    for (const Point& point : marking.points)
      if (!point.allFinite()) __builtin_trap();
}

}  // namespace

/// A mapper works with any profile that is taken.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  take_or_refuse([&] {
    MapperConfig config;
    config.fusion.profile_file = file.path();
    config.networks = config::load_network_profiles(file.path());
    Mapper mapper(config);
    Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
    for (const auto& [source, profile] : config.networks) {
      for (int i = 1; i <= 3; ++i) {
        T_map_body.translation().x() += 1.0;
        mapper.update(frame_of_two_lines(source, i * 100'000'000), T_map_body);
      }
    }
    check(mapper);
  });
  return 0;
}
