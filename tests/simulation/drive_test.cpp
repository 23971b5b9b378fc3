#include "simulation/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace laneloom::simulation {
namespace {

double yaw_rad(const VehiclePose& pose) {
  const Point forward = pose.orientation * Point::UnitX();
  return std::atan2(forward.y(), forward.x());
}

TEST(Drive, GoesAlongAStraightPathAtItsSpeed) {
  const Drive drive = Drive::along({{0.0, 0.0, 1.0}, {0.0, 100.0, 1.0}}, 5.0);
  EXPECT_NEAR(drive.duration_s(), 20.0, 1e-6);
  const VehiclePose pose = drive.pose_at(4.0);
  EXPECT_NEAR((pose.position - Point(0.0, 20.0, 1.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(yaw_rad(pose), 0.5 * std::numbers::pi, 1e-9);
  EXPECT_EQ(pose.stamp_ns, 4'000'000'000);
  EXPECT_EQ(drive.pose_at(1e6).position, drive.poses().back().position) << "stays at its end";
}

TEST(Drive, PitchesUpWhereThePathClimbs) {
  const Drive drive = Drive::along({{0.0, 0.0, 0.0}, {100.0, 0.0, 10.0}}, 10.0);
  const Point forward = drive.pose_at(5.0).orientation * Point::UnitX();
  EXPECT_NEAR(forward.z() / forward.x(), 0.1, 1e-9);
}

TEST(Drive, TurnsSteadilyThroughACorner) {
  const Drive drive = Drive::along({{0.0, 0.0, 0.0}, {50.0, 0.0, 0.0}, {50.0, 50.0, 0.0}}, 10.0);
  double last_rad = 0.0;
  for (double t = 0.0; t < drive.duration_s(); t += 0.02) {
    const double now_rad = yaw_rad(drive.pose_at(t));
    EXPECT_LT(std::abs(now_rad - last_rad), 0.15);
    last_rad = now_rad;
  }
  EXPECT_NEAR(last_rad, 0.5 * std::numbers::pi, 1e-6);
}

TEST(Drive, ARingIsClosedAndGoesRound) {
  Polyline ring;
  for (int i = 0; i <= 72; ++i) {
    const double angle = i * std::numbers::pi / 36.0;
    ring.emplace_back(20.0 * std::sin(angle), -20.0 * std::cos(angle), 0.0);
  }
  ring.back() = ring.front();
  const Drive drive = Drive::along(ring, 10.0);
  ASSERT_TRUE(drive.closed());
  const VehiclePose here = drive.pose_at(1.0), again = drive.pose_at(1.0 + 3.0 * drive.duration_s());
  EXPECT_LT((here.position - again.position).norm(), 1e-6);
  EXPECT_GT(again.stamp_ns, here.stamp_ns);
}

TEST(Drive, InterpolatesRecordedPoses) {
  VehiclePose a, b;
  a.stamp_ns = 1'000;
  b.stamp_ns = 1'000'001'000;
  b.position = {10.0, 0.0, 0.0};
  b.orientation = Eigen::AngleAxisd(1.0, Point::UnitZ());
  const Drive drive = Drive::recorded({a, b});
  EXPECT_DOUBLE_EQ(drive.duration_s(), 1.0);
  EXPECT_NEAR(drive.pose_at(0.25).position.x(), 2.5, 1e-9);
  EXPECT_NEAR(yaw_rad(drive.pose_at(0.25)), 0.25, 1e-9);
  EXPECT_FALSE(drive.closed());
}

TEST(Drive, RefusesWhatCannotBeDriven) {
  EXPECT_THROW(Drive::along({{0.0, 0.0, 0.0}}, 5.0), std::invalid_argument);
  EXPECT_THROW(Drive::along({{0.0, 0.0, 0.0}, {9.0, 0.0, 0.0}}, 0.0), std::invalid_argument);
  EXPECT_THROW(Drive::recorded({VehiclePose{}, VehiclePose{}}), std::invalid_argument);
}

}  // namespace
}  // namespace laneloom::simulation
