#include "session/gate.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/degree.hpp"
#include "milliseconds.hpp"

namespace laneloom::session {
namespace {

using Verdict = Gate::Verdict;

StreamPoint at(std::int64_t stamp_ms, double x = 0.0, std::uint64_t session = 1) {
  return {stamp_ms * kMs, session, {x, 0.0, 0.0}};
}

class GateTest : public ::testing::Test {
 protected:
  GateTest() { EXPECT_EQ(gate_.check(at(10'000)), Verdict::accepted); }
  Gate gate_{GateConfig{}};
};

TEST_F(GateTest, ASteadyStreamIsAccepted) {
  for (int i = 1; i < 50; ++i) EXPECT_EQ(gate_.check(at(10'000 + 100 * i, 3.0 * i)), Verdict::accepted);
  EXPECT_EQ(gate_.check(at(16'900, 150.0)), Verdict::accepted);  // a gap of 2 s
}

TEST_F(GateTest, OneOutlierIsRefusedAndTheStreamGoesOn) {
  for (const auto& outlier : {at(3'610'000), at(10'000 - 3'600'000), at(10'050, 100.0)}) {
    EXPECT_EQ(gate_.check(outlier), Verdict::outlier);
  }
  EXPECT_EQ(gate_.check(at(10'100)), Verdict::accepted);
}

TEST_F(GateTest, ThreeConsistentOutliersAreBelieved) {
  EXPECT_EQ(gate_.check(at(3'610'000)), Verdict::outlier);
  EXPECT_EQ(gate_.check(at(3'610'100)), Verdict::outlier);
  EXPECT_EQ(gate_.check(at(3'610'200)), Verdict::begins_anew);
  EXPECT_EQ(gate_.check(at(3'610'300)), Verdict::accepted);
  EXPECT_EQ(gate_.check(at(10'100)), Verdict::outlier);
}

TEST_F(GateTest, OutliersThatDisagreeAreNotBelieved) {
  for (int i = 0; i < 10; ++i) EXPECT_EQ(gate_.check(at(100'000 + i * 10'000)), Verdict::outlier);
}

TEST_F(GateTest, AGoodMessageEndsTheRow) {
  EXPECT_EQ(gate_.check(at(10'050, 100.0)), Verdict::outlier);
  EXPECT_EQ(gate_.check(at(10'060, 100.0)), Verdict::outlier);
  EXPECT_EQ(gate_.check(at(10'070)), Verdict::accepted);
  EXPECT_EQ(gate_.check(at(10'080, 100.0)), Verdict::outlier);
}

TEST_F(GateTest, AJumpOfThePoseIsBelievedWhenItStays) {
  EXPECT_EQ(gate_.check(at(10'010, 100.0)), Verdict::outlier);
  EXPECT_EQ(gate_.check(at(10'020, 100.1)), Verdict::outlier);
  EXPECT_EQ(gate_.check(at(10'030, 100.2)), Verdict::begins_anew);
}

TEST_F(GateTest, RepeatedAndLateMessagesAreNoOutliers) {
  EXPECT_EQ(gate_.check(at(10'100)), Verdict::accepted);
  EXPECT_EQ(gate_.check(at(10'100)), Verdict::repeated);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(gate_.check(at(10'000 + i)), Verdict::late);
  EXPECT_EQ(gate_.check(at(10'200)), Verdict::accepted);
}

StreamPoint turned(std::int64_t stamp_ms, double yaw_deg) {
  StreamPoint point = at(stamp_ms);
  point.orientation = Eigen::AngleAxisd(yaw_deg * kDegree, Eigen::Vector3d::UnitZ());
  return point;
}

TEST_F(GateTest, ATurnThatNoVehicleMakesIsAnOutlier) {
  EXPECT_EQ(gate_.check(turned(10'100, 26.0)), Verdict::accepted);
  EXPECT_EQ(gate_.check(turned(10'200, 54.0)), Verdict::outlier);
  EXPECT_EQ(gate_.check(turned(10'210, 26.0)), Verdict::accepted);
  EXPECT_EQ(gate_.check(turned(10'220, -154.0)), Verdict::outlier);
  EXPECT_EQ(gate_.check(turned(10'230, -154.0)), Verdict::outlier);
  EXPECT_EQ(gate_.check(turned(10'240, -154.0)), Verdict::begins_anew);
}

TEST_F(GateTest, AClockThatIsSetBackBeginsAnewIfThatIsWanted) {
  Gate anew(GateConfig{}, true);
  EXPECT_EQ(anew.check(at(10'000)), Verdict::accepted);
  for (int t = 9'000; t < 9'200; t += 10) {
    EXPECT_EQ(anew.check(at(t)), Verdict::late);
    EXPECT_EQ(gate_.check(at(t)), Verdict::late);
  }
  EXPECT_EQ(anew.check(at(9'200)), Verdict::begins_anew);
  EXPECT_EQ(gate_.check(at(9'200)), Verdict::late);
  EXPECT_EQ(anew.check(at(9'210)), Verdict::accepted);
}

TEST_F(GateTest, LateMessagesBetweenOthersAreNoClockThatIsSetBack) {
  Gate anew(GateConfig{}, true);
  for (int t = 10'000; t < 11'000; t += 10) {
    EXPECT_EQ(anew.check(at(t)), Verdict::accepted);
    EXPECT_EQ(anew.check(at(t - 500)), Verdict::late);
  }
}

TEST_F(GateTest, AStampThatWasAheadIsFoundWrong) {
  for (const int ahead : {250, 500, 1'900}) {
    Gate gate(GateConfig{}, true);
    for (int t = 10'000; t <= 10'100; t += 10) EXPECT_EQ(gate.check(at(t)), Verdict::accepted);
    EXPECT_EQ(gate.check(at(10'110 + ahead)), Verdict::accepted);
    for (int t = 10'120; t < 10'220; t += 10) EXPECT_EQ(gate.check(at(t)), Verdict::late) << ahead;
    EXPECT_EQ(gate.check(at(10'210 + ahead)), Verdict::accepted) << "a second one";
    for (int t = 10'220; t < 10'420; t += 10) EXPECT_EQ(gate.check(at(t)), Verdict::late) << ahead;
    EXPECT_EQ(gate.check(at(10'420)), Verdict::corrects) << ahead;
    EXPECT_EQ(gate.check(at(10'430)), Verdict::accepted);
  }
}

TEST_F(GateTest, LateMessagesAtAnotherPlaceDoNotCorrect) {
  Gate anew(GateConfig{}, true);
  for (const int t : {10'000, 10'010, 10'500}) EXPECT_EQ(anew.check(at(t)), Verdict::accepted);
  for (int t = 10'020; t < 10'220; t += 10) EXPECT_EQ(anew.check(at(t, 100.0)), Verdict::late);
  EXPECT_EQ(anew.check(at(10'220, 100.0)), Verdict::begins_anew);
}

TEST_F(GateTest, ANewSessionIsBelievedAtOnce) {
  EXPECT_EQ(gate_.check(at(10'100, 0.0, 2)), Verdict::begins_anew);
  EXPECT_EQ(gate_.check(at(5, 500.0, 3)), Verdict::begins_anew);
  EXPECT_EQ(gate_.check(at(15, 500.0, 3)), Verdict::accepted);
}

TEST_F(GateTest, TwoWritersAtOnceDoNotResetEachOther) {
  EXPECT_EQ(gate_.check(at(10'100, 0.0, 2)), Verdict::begins_anew);
  for (int i = 1; i < 20; ++i) {
    EXPECT_EQ(gate_.check(at(10'100 + 100 * i, 0.0, 1)), Verdict::outlier);
    EXPECT_EQ(gate_.check(at(10'100 + 100 * i, 0.0, 2)), Verdict::accepted);
  }
  // The older one is alone again.
  EXPECT_EQ(gate_.check(at(13'000, 0.0, 1)), Verdict::outlier);
  EXPECT_EQ(gate_.check(at(13'100, 0.0, 1)), Verdict::outlier);
  EXPECT_EQ(gate_.check(at(13'200, 0.0, 1)), Verdict::begins_anew);
  EXPECT_EQ(gate_.check(at(13'300, 0.0, 1)), Verdict::accepted);
}

TEST_F(GateTest, OfTwoWritersTheQuickerOneIsBelieved) {
  EXPECT_EQ(gate_.check(at(10'010, 0.0, 2)), Verdict::begins_anew);
  int anew = 0;
  for (int t = 10'020; t < 12'000; t += 10) {
    anew += gate_.check(at(t, 0.0, 1)) == Verdict::begins_anew ? 1 : 0;
    if (t % 50 == 0) {
      EXPECT_EQ(gate_.check(at(t + 5, 0.0, 2)), Verdict::outlier) << t;
    }
  }
  EXPECT_EQ(anew, 1);
}

DetectionFrame good_frame() {
  DetectionFrame frame{.stamp_ns = 5};
  frame.detections.push_back(Detection{.confidence = 0.5, .points = {{0, 0, 0}, {10, 0, 0}}});
  return frame;
}

std::string_view with(const std::function<void(DetectionFrame&)>& damage) {
  auto frame = good_frame();
  damage(frame);
  return defect(frame, GateConfig{});
}

TEST(Defect, OfFrames) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(defect(good_frame(), GateConfig{}), "");
  EXPECT_EQ(with([](auto& f) { f.stamp_ns = 0; }), "stamp");
  EXPECT_EQ(with([](auto& f) { f.stamp_ns = std::numeric_limits<std::int64_t>::min(); }), "stamp");
  EXPECT_EQ(with([](auto& f) { f.stamp_ns = std::numeric_limits<std::int64_t>::max(); }), "stamp");
  EXPECT_EQ(with([](auto& f) { f.detections[0].points.pop_back(); }), "too_few_points");
  EXPECT_EQ(with([](auto& f) { f.detections[0].points[1].y() = 2e7; }), "coordinate");
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(with([&](auto& f) { f.detections[0].points[1][axis] = nan; }), "coordinate") << axis;
  }
  EXPECT_EQ(with([&](auto& f) { f.field_of_view = {{0, nan, 0}}; }), "coordinate");
  EXPECT_EQ(with([](auto& f) { f.field_of_view = {{0, -9, 0}, {60, 9, 0}}; }), "too_few_points");
  EXPECT_EQ(with([](auto& f) { f.field_of_view = {{0, -9, 0}, {60, 9, 0}, {0, 9, 0}}; }), "");
  EXPECT_EQ(with([&](auto& f) { f.occluded_areas = {{{0, nan, 0}}}; }), "coordinate");
  EXPECT_EQ(with([&](auto& f) { f.detections[0].confidence = nan; }), "confidence");
  EXPECT_EQ(with([](auto& f) { f.detections[0].confidence = 1.1; }), "confidence");
  EXPECT_EQ(with([](auto& f) { f.detections[0].stddev_m = {0.1}; }), "wrong_size");
  EXPECT_EQ(with([](auto& f) { f.detections[0].stddev_m = {0.1, -0.1}; }), "stddev");
  EXPECT_EQ(with([&](auto& f) { f.detections[0].stddev_m = {0.1, nan}; }), "stddev");
}

TEST(Defect, OfPoses) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const GateConfig config;
  EXPECT_EQ(defect(VehiclePose{.stamp_ns = 5}, config), "");
  EXPECT_EQ(defect(VehiclePose{.stamp_ns = -5}, config), "stamp");
  EXPECT_EQ(defect(VehiclePose{.stamp_ns = 5, .position = {0, 0, nan}}, config), "coordinate");
  EXPECT_EQ(defect(VehiclePose{.stamp_ns = 5, .position = {-2e7, 0, 0}}, config), "coordinate");
  EXPECT_EQ(defect(VehiclePose{.stamp_ns = 5, .orientation = {0.9, 0, 0, 0}}, config), "not_a_rotation");
  EXPECT_EQ(defect(VehiclePose{.stamp_ns = 5, .orientation = {nan, 0, 0, 0}}, config), "not_a_rotation");
}

std::string_view defect_of(const TrackedObject& object) {
  return defect(TrackedObjects{.stamp_ns = 5, .objects = {object}}, GateConfig{});
}

TEST(Defect, OfObjects) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(defect_of({}), "") << "nothing but a place is known";
  EXPECT_EQ(defect_of({.existence_probability = 1.0, .heading = {0, 1, 0}, .speed_mps = -3.0}), "");
  EXPECT_EQ(defect(TrackedObjects{}, GateConfig{}), "stamp");
  EXPECT_EQ(defect_of({.position = {0, nan, 0}}), "coordinate");
  EXPECT_EQ(defect_of({.position = {2e7, 0, 0}}), "coordinate");
  EXPECT_EQ(defect_of({.heading = {0.5, 0, 0}}), "heading");
  EXPECT_EQ(defect_of({.heading = {nan, 0, 0}}), "heading");
  EXPECT_EQ(defect_of({.speed_mps = nan}), "speed");
  EXPECT_EQ(defect_of({.speed_mps = -90.0}), "speed");
  EXPECT_EQ(defect_of({.existence_probability = -0.5}), "existence");
  EXPECT_EQ(defect_of({.existence_probability = 1.1}), "existence");
  EXPECT_EQ(defect_of({.position_stddev_m = -0.5}), "length");
  EXPECT_EQ(defect_of({.length_m = nan}), "length");
  EXPECT_EQ(defect_of({.width_m = -2.0}), "length");
  TrackedObjects doubles{.stamp_ns = 5, .objects = {{.id = 3}, {.id = 4}, {.id = 3}}};
  EXPECT_EQ(defect(doubles, GateConfig{}), "repeated_id");
  doubles.objects.back().id = 5;
  EXPECT_EQ(defect(doubles, GateConfig{}), "");
}

TEST(Defect, OfTurns) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(defect(NextTurn{.stamp_ns = 5}, GateConfig{}), "") << "it is here";
  EXPECT_EQ(defect(NextTurn{}, GateConfig{}), "stamp");
  for (const double distance_m : {-0.1, nan, 2e7})
    EXPECT_EQ(defect(NextTurn{.stamp_ns = 5, .distance_m = distance_m}, GateConfig{}), "distance");
}

}  // namespace
}  // namespace laneloom::session
