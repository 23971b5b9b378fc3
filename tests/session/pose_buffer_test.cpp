#include "session/pose_buffer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "milliseconds.hpp"

namespace laneloom::session {
namespace {

Eigen::Quaterniond about(const Point& axis, double angle_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis.normalized()));
}

VehiclePose pose(std::int64_t stamp_ns, const Point& position, double yaw_rad = 0.0) {
  return {.stamp_ns = stamp_ns, .position = position, .orientation = about(Point::UnitZ(), yaw_rad)};
}

SyncConfig config() {
  SyncConfig result;
  result.max_pose_gap_s = 0.2;
  result.pose_history_s = 1.0;
  return result;
}

using Answer = PoseBuffer::Answer;

TEST(PoseBuffer, InterpolatesBetweenTwoPoses) {
  PoseBuffer poses(config());
  poses.add(pose(100 * kMs, {1.0, 2.0, 3.0}, 0.2));
  poses.add(pose(200 * kMs, {2.0, 4.0, 1.0}, 0.6));
  Eigen::Isometry3d T_map_body;
  ASSERT_EQ(poses.at(125 * kMs, T_map_body), Answer::found);
  EXPECT_TRUE(T_map_body.translation().isApprox(Point(1.25, 2.5, 2.5), 1e-12));
  EXPECT_TRUE(T_map_body.linear().isApprox(about(Point::UnitZ(), 0.3).toRotationMatrix(), 1e-9));
}

TEST(PoseBuffer, APoseAtTheVeryStampIsTaken) {
  PoseBuffer poses(config());
  poses.add(pose(100 * kMs, {1.0, 0.0, 0.0}));
  Eigen::Isometry3d T_map_body;
  ASSERT_EQ(poses.at(100 * kMs, T_map_body), Answer::found);
  EXPECT_EQ(T_map_body.translation(), Point(1.0, 0.0, 0.0));
}

TEST(PoseBuffer, NeverExtrapolates) {
  PoseBuffer poses(config());
  Eigen::Isometry3d T_map_body;
  EXPECT_EQ(poses.at(100 * kMs, T_map_body), Answer::not_yet);
  poses.add(pose(100 * kMs, Point::Zero()));
  poses.add(pose(200 * kMs, Point::Zero()));
  EXPECT_EQ(poses.at(200 * kMs + 1, T_map_body), Answer::not_yet);
  EXPECT_EQ(poses.at(100 * kMs - 1, T_map_body), Answer::never);
}

TEST(PoseBuffer, RefusesABracketThatIsTooWide) {
  PoseBuffer poses(config());
  poses.add(pose(100 * kMs, Point::Zero()));
  poses.add(pose(300 * kMs, Point::Zero()));
  poses.add(pose(500 * kMs + 1, Point::Zero()));
  Eigen::Isometry3d T_map_body;
  EXPECT_EQ(poses.at(200 * kMs, T_map_body), Answer::found);
  EXPECT_EQ(poses.at(400 * kMs, T_map_body), Answer::never);
}

TEST(PoseBuffer, ForgetsWhatIsOlderThanItsHistory) {
  PoseBuffer poses(config());
  for (int i = 0; i <= 20; ++i) poses.add(pose((1 + i) * 100 * kMs, Point::Zero()));
  Eigen::Isometry3d T_map_body;
  EXPECT_EQ(poses.at(1100 * kMs, T_map_body), Answer::found);
  EXPECT_EQ(poses.at(1099 * kMs, T_map_body), Answer::never);
}

TEST(PoseBuffer, IsBounded) {
  PoseBuffer poses(config());
  constexpr std::int64_t kMost = 65536, kLast = 2 * kMost;
  for (std::int64_t stamp_ns = 1; stamp_ns <= kLast; ++stamp_ns) poses.add(pose(stamp_ns, Point::Zero()));
  Eigen::Isometry3d T_map_body;
  EXPECT_EQ(poses.at(kLast - kMost + 1, T_map_body), Answer::found);
  EXPECT_EQ(poses.at(kLast - kMost, T_map_body), Answer::never);
}

// The queue bounds what comes between two ticks. The history goes on for longer.
TEST(PoseBuffer, KeepsItsHistoryHoweverShortTheQueueIs) {
  auto short_queue = config();
  short_queue.pose_queue_capacity = 3;
  PoseBuffer poses(short_queue);
  for (int i = 0; i < 300; ++i) poses.add(pose((1 + i) * kMs, Point::Zero()));
  Eigen::Isometry3d T_map_body;
  EXPECT_EQ(poses.at(100 * kMs, T_map_body), Answer::found);
}

TEST(Slerp, AgreesWithTheFormula) {
  for (const double angle : {0.0, 1e-9, 0.01, 0.7, 2.0, 3.0, 3.14}) {
    const auto from = about({1, 2, 3}, 0.4);
    const auto to = from * about({-1, 0.5, 2}, angle);
    for (const double share : {0.0, 0.001, 0.25, 0.5, 0.777, 1.0}) {
      EXPECT_LT(slerp(from, to, share).angularDistance(from.slerp(share, to)), 1e-8) << angle << " " << share;
    }
  }
}

TEST(Slerp, TakesTheShorterWayWhateverTheSigns) {
  const auto from = about(Point::UnitZ(), 0.1);
  auto to = about(Point::UnitZ(), 0.3);
  to.coeffs() = -to.coeffs();
  EXPECT_LT(slerp(from, to, 0.5).angularDistance(about(Point::UnitZ(), 0.2)), 1e-9);
}

}  // namespace
}  // namespace laneloom::session
