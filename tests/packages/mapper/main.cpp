#include <cstdio>
#include <exception>

#include "laneloom/lane_graph.hpp"
#include "laneloom/mapper.hpp"

namespace {

/// Two lines 3.5 m apart, as a vehicle between them sees them.
laneloom::DetectionFrame frame_at(int number) {
  laneloom::DetectionFrame frame;
  frame.stamp_ns = number * 100'000'000LL;
  for (const double y : {1.75, -1.75}) {
    laneloom::Detection line{.style = laneloom::MarkingStyle::solid, .confidence = 0.9};
    for (int x = 0; x <= 25; ++x) line.points.emplace_back(x, y, 0.0);
    frame.detections.push_back(line);
  }
  return frame;
}

}  // namespace

/// Exit code 1: the vehicle is in no lane, or a mapper that goes on from the saved state says something else.
int main() try {
  laneloom::Mapper mapper(laneloom::MapperConfig{}), other(laneloom::MapperConfig{});
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  for (int i = 1; i <= 30; ++i) {
    T_map_body.translation().x() = 1.0 * i;
    mapper.update(frame_at(i), T_map_body);
  }
  other.load(mapper.save());
  const laneloom::LaneGraph graph(other.map());
  const auto own = graph.own_lane(T_map_body);
  if (!own || other.save() != mapper.save()) return 1;
  std::printf("lane %llu, %.2f m wide, %.2f m from its middle\n",
              static_cast<unsigned long long>(own->lane.lane->id), own->lane.lane->width_m, own->offset_m);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
