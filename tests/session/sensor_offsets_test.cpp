#include "session/sensor_offsets.hpp"

#include <gtest/gtest.h>

#include "laneloom/error.hpp"

namespace laneloom::session {
namespace {

DetectionFrame frame_of(const std::string& source) {
  DetectionFrame frame;
  frame.source = source;
  frame.detections = {{.points = {{1.0, 2.0, 0.5}, {9.0, -2.0, 0.5}}}};
  frame.field_of_view = {{0.0, -9.0, 0.0}, {30.0, 0.0, 0.0}, {0.0, 9.0, 0.0}};
  frame.occluded_areas = {{{5.0, 0.0, 0.0}, {6.0, 0.0, 0.0}, {6.0, 1.0, 0.0}}};
  return frame;
}

TEST(SensorOffsets, MoveAllPointsOfTheirSourceToTheLeft) {
  NetworkProfiles profiles{{"front", {{kSensorLeft, {0.25, 1.0}}, {"pitch_gain", {0.5, 9.0}}}}};
  const SensorOffsets offsets(profiles);
  DetectionFrame moved = frame_of("front"), other = frame_of("rear");
  offsets.apply(moved);
  offsets.apply(other);
  EXPECT_EQ(moved.detections[0].points[1], Point(9.0, -1.75, 0.5));
  EXPECT_EQ(moved.field_of_view[2], Point(0.0, 9.25, 0.0));
  EXPECT_EQ(moved.occluded_areas[0][2], Point(6.0, 1.25, 0.0));
  EXPECT_EQ(other.detections[0].points, frame_of("rear").detections[0].points);
}

TEST(SensorOffsets, LeaveTheMapperItsValues) {
  NetworkProfiles profiles{{"front", {{kSensorLeft, {0.25, 1.0}}, {"pitch_gain", {0.5, 9.0}}}}};
  const SensorOffsets offsets(profiles);
  EXPECT_EQ(profiles, (NetworkProfiles{{"front", {{"pitch_gain", {0.5, 9.0}}}}}));
}

TEST(SensorOffsets, RefuseWhatNoVehicleIsWideEnoughFor) {
  NetworkProfiles profiles{{"front", {{kSensorLeft, {10.5, 1.0}}}}};
  EXPECT_THROW(SensorOffsets{profiles}, ConfigError);
}

}  // namespace
}  // namespace laneloom::session
