#include <gtest/gtest.h>

#include <algorithm>

#include "simulated_drive.hpp"

// A service that was killed goes on with its snapshot; deploy/README.md, "After a crash".
namespace laneloom::service {
namespace {

using States = std::vector<std::string>;

Config with_snapshots() {
  Config config;
  config.service.snapshot_file = "kept by the test";
  return config;
}

TEST(Restart, GoesOnWithTheMapThatItHad) {
  SimulatedDrive drive(with_snapshots());
  drive.run_for(3000);
  ASSERT_TRUE(drive.snapshot());
  const PublishedMap before = drive.maps().back();
  drive.restart();
  drive.run_for(2000);
  const PublishedMap first = drive.maps().front();
  EXPECT_NE(first.session_id, before.session_id);
  EXPECT_EQ(first.map_id, before.map_id);
  for (const PublishedMap& map : drive.maps()) {
    ASSERT_EQ(map.map.lanes.size(), 1U);
    EXPECT_EQ(map.map.lanes[0].id, before.map.lanes[0].id);
  }
  EXPECT_EQ(drive.state(), "OK");
  EXPECT_EQ(drive.counter("map_resets"), 0U);
}

TEST(Restart, AMapIsStaleUntilAFrameHasConfirmedIt) {
  SimulatedDrive drive(with_snapshots());
  drive.run_for(3000);
  drive.send_frames = lose<DetectionFrame>;
  drive.run_for(100);
  drive.restart();
  drive.run_for(300);
  EXPECT_EQ(drive.maps().back().map.lanes.size(), 1U);
  EXPECT_EQ(drive.maps().back().state, MapState::stale);
  EXPECT_GT(drive.maps().back().age_s, 0.0);
  EXPECT_FALSE(drive.snapshot()) << "a map that was only resumed would be kept for ever";
  drive.send_frames = {};
  drive.run_for(1000);
  EXPECT_EQ(drive.state(), "OK");
}

TEST(Restart, ForgetsAMapOfAnotherPoseFrame) {
  SimulatedDrive drive(with_snapshots());
  drive.run_for(3000);
  const auto map_id = drive.maps().back().map_id;
  drive.send_poses = [](VehiclePose pose) {
    pose.session_id = 99;
    return std::vector{pose};
  };
  drive.restart();
  drive.run_for(2000);
  EXPECT_EQ(drive.state(), "OK");
  EXPECT_NE(drive.maps().back().map_id, map_id);
  EXPECT_EQ(drive.counter("map_resets"), 1U);
}

TEST(Restart, KeepsASnapshotPerPeriodIfAFileIsConfigured) {
  SimulatedDrive without;
  without.run_for(3000);
  EXPECT_FALSE(without.snapshot());

  SimulatedDrive drive(with_snapshots());
  drive.run_for(2000);
  const auto first_ns = drive.snapshot()->stamp.steady_ns;
  drive.run_for(100);
  EXPECT_EQ(drive.snapshot()->stamp.steady_ns, first_ns);
  drive.run_for(200);
  EXPECT_EQ(drive.snapshot()->stamp.steady_ns, first_ns + 1'000'000'000);
}

TEST(Restart, AnotherMapperMakesAnotherSnapshot) {
  const auto maker = [](const Config& config) {
    const auto zero = [] { return std::int64_t{0}; };
    return core::ServiceCore(config, {zero, zero, [] { return std::uint64_t{1}; }}).snapshot_stamp().maker;
  };
  Config other = with_snapshots();
  other.service.stale_after_s = 30.0;
  other.ros2.enabled = true;
  EXPECT_EQ(maker(other), maker(with_snapshots())) << "they make the same maps";
  other.mapper.lane.min_width_m += 0.1;
  EXPECT_NE(maker(other), maker(with_snapshots()));
}

}  // namespace
}  // namespace laneloom::service
