#include "session/admission.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace laneloom::session {
namespace {

using testing::ElementsAre;

/// A line of 10 m that begins so far ahead.
Detection line(double confidence, double ahead_m, double length_m = 10.0) {
  return {.confidence = confidence, .points = {{ahead_m, 0, 0}, {ahead_m + length_m, 0, 0}}};
}

std::vector<double> begins(const DetectionFrame& frame) {
  std::vector<double> ahead_m;
  for (const Detection& detection : frame.detections) ahead_m.push_back(detection.points[0].x());
  return ahead_m;
}

GateConfig bounds(int detections, double length_m) {
  GateConfig config;
  config.max_frame_detections = detections;
  config.max_frame_length_m = length_m;
  return config;
}

TEST(Admission, LeavesAFrameWithinTheBoundsAsItIs) {
  DetectionFrame frame{.detections = {line(0.1, 30), line(0.9, 2)}};
  EXPECT_EQ(admit(bounds(2, 20.0), frame), 0U);
  EXPECT_THAT(begins(frame), ElementsAre(30, 2));
}

TEST(Admission, LeavesOutTheLeastTrustedFirst) {
  DetectionFrame frame{.detections = {line(0.5, 1), line(0.4, 2), line(0.9, 3), line(0.6, 4)}};
  EXPECT_EQ(admit(bounds(2, 1000.0), frame), 2U);
  EXPECT_THAT(begins(frame), ElementsAre(3, 4)) << "in the order of the frame";
}

TEST(Admission, OfEquallyTrustedOnesLeavesOutTheFarthest) {
  DetectionFrame frame{.detections = {line(0.5, 20), line(0.5, -3), line(0.5, 5)}};
  EXPECT_EQ(admit(bounds(3, 25.0), frame), 1U);
  EXPECT_THAT(begins(frame), ElementsAre(-3, 5));
}

TEST(Admission, ALineThatIsTooLongAloneDoesNotKeepOthersOut) {
  DetectionFrame frame{.detections = {line(0.9, 1, 5000.0), line(0.3, 2)}};
  EXPECT_EQ(admit(bounds(9, 100.0), frame), 1U);
  EXPECT_THAT(begins(frame), ElementsAre(2));
}

TEST(Admission, StandsADetectionWithoutPoints) {
  DetectionFrame frame;
  frame.detections.resize(4);
  EXPECT_EQ(admit(bounds(3, 100.0), frame), 1U);
}

}  // namespace
}  // namespace laneloom::session
