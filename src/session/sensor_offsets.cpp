#include "session/sensor_offsets.hpp"

#include <cmath>

#include "laneloom/error.hpp"

namespace laneloom::session {
namespace {

constexpr double kFarthest_m = 10.0;

}  // namespace

SensorOffsets::SensorOffsets(NetworkProfiles& profiles) {
  for (auto& [source, profile] : profiles) {
    const auto offset = profile.extract(kSensorLeft);
    if (!offset) continue;
    const double left_m = offset.mapped().value;
    if (!(std::abs(left_m) <= kFarthest_m))
      throw ConfigError("the profile of the network \"" + source + "\": " + kSensorLeft + " is beyond 10 m");
    left_m_[source] = left_m;
  }
}

void SensorOffsets::apply(DetectionFrame& frame) const {
  const auto offset = left_m_.find(frame.source);
  if (offset == left_m_.end()) return;
  const auto move = [left_m = offset->second](Polyline& line) {
    for (Point& point : line) point.y() += left_m;
  };
  for (Detection& detection : frame.detections) move(detection.points);
  move(frame.field_of_view);
  for (Polyline& area : frame.occluded_areas) move(area);
}

}  // namespace laneloom::session
