#include "check/agreement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "check/drives.hpp"
#include "io/axes.hpp"

namespace laneloom::check {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(Agreement, FramesWithoutNoiseAgree) {
  const Drive drive = simulated_drive("town", "none");
  const PoseTrack poses(drive.poses);
  const Agreement agreement(drive.frames.at(""), poses, 1.0);
  ASSERT_TRUE(agreement.can_tell());
  EXPECT_TRUE(agreement.plausible({}));
  EXPECT_LT(mean(agreement.disagreements({})), 0.03);
  EXPECT_GT(mean(agreement.disagreements({.axes = "forward-right"})), 0.2);
}

TEST(Agreement, AVehicleThatStandsTellsNothing) {
  Drive drive = simulated_drive("town", "none");
  for (VehiclePose& pose : drive.poses) pose.position = Point::Zero();
  const PoseTrack poses(drive.poses);
  EXPECT_FALSE(Agreement(drive.frames.at(""), poses, 1.0).can_tell());
  const PoseTrack none({});
  EXPECT_FALSE(Agreement(drive.frames.at(""), none, 1.0).can_tell());
}

TEST(Agreement, WhatIsAgainstSenseIsNotPlausible) {
  const Drive drive = simulated_drive("curve", "none");
  const PoseTrack poses(drive.poses);
  const Agreement agreement(drive.frames.at(""), poses, 1.0);
  EXPECT_FALSE(agreement.drives_forward({.scalar_first = true}));
  EXPECT_FALSE(agreement.lines_lie_well({.axes = "right-forward"})) << "lines across the way";
  EXPECT_FALSE(agreement.lines_lie_well({.axes = "right-down-forward"})) << "lines that rise into the sky";
  EXPECT_FALSE(agreement.lines_lie_well({.point_scale = 1000.0})) << "lines far away";
}

TEST(Agreement, ManyLinesMayCrossTheWayAndManyFramesMayShowStopLinesAlone) {
  Drive drive = simulated_drive("curve", "none");
  for (std::size_t i = 0; i < drive.frames.at("").size(); ++i) {
    std::vector<Detection>& lines = drive.frames.at("")[i].detections;
    const std::vector<Detection> along = lines;
    if (i % 3 == 0) lines.clear();
    for (Detection line : along) {
      for (Point& point : line.points) point = Point(-1.5 * point.y(), 1.5 * point.x(), point.z());
      if (i % 3 == 0) line.type = MarkingType::stopline;
      lines.push_back(line);
    }
  }
  const PoseTrack poses(drive.poses);
  EXPECT_TRUE(Agreement(drive.frames.at(""), poses, 1.0).lines_lie_well({}));
}

TEST(PoseTrack, InterpolatesBetweenPosesThatAreNotTooFarApart) {
  const auto pose_at = [](std::int64_t stamp_ns, double x) {
    return VehiclePose{.stamp_ns = stamp_ns, .position = {x, 0.0, 0.0}};
  };
  const PoseTrack poses(
      {pose_at(2'000'000'000, 2.0), pose_at(1'000'000'000, 1.0), pose_at(9'000'000'000, 9.0)});
  ASSERT_TRUE(poses.at(1'500'000'000, {}));
  EXPECT_EQ(poses.at(1'500'000'000, {})->translation(), Point(1.5, 0.0, 0.0));
  EXPECT_EQ(poses.at(2'000'000'000, {})->translation(), Point(2.0, 0.0, 0.0));
  EXPECT_EQ(poses.at(2'000'000'000, {.pose_time_s = 0.5})->translation(), Point(1.5, 0.0, 0.0));
  EXPECT_FALSE(poses.at(500'000'000, {}));
  EXPECT_FALSE(poses.at(5'000'000'000, {})) << "the poses around it are 7 s apart";
  EXPECT_FALSE(poses.at(9'500'000'000, {}));
}

TEST(Axes, AreNamedByTheirDirections) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  EXPECT_EQ(io::axes_named("forward-left"), Eigen::Matrix3d::Identity());
  EXPECT_EQ(io::axes_named("right-forward") * x, -y);
  EXPECT_EQ(io::axes_named("right-forward") * y, x);
  EXPECT_EQ(io::axes_named("right-down-forward") * z, x);
  EXPECT_EQ(io::axes_named("right-down-forward") * y, -z);
  for (const std::string name : {"", "forward", "forward-", "forward-backward", "forward-left-up-down",
                                 "left-up", "north-west", "forward-left-"})
    EXPECT_THROW(io::axes_named(name), std::invalid_argument) << name;
}

}  // namespace
}  // namespace laneloom::check
