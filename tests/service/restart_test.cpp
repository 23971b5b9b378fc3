#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "simulated_drive.hpp"
#include "temporary_folder.hpp"

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

  const TemporaryFolder folder;
  other.mapper.fusion.profile_file = folder.file("networks.yaml");
  std::ofstream(other.mapper.fusion.profile_file) << "front: {stddev_at_8_m: {value: 0.03, weight: 5400}}\n";
  const std::string before = maker(other);
  std::ofstream(other.mapper.fusion.profile_file) << "front: {stddev_at_8_m: {value: 0.04, weight: 5400}}\n";
  EXPECT_NE(maker(other), before);

  other.sd_map.file = folder.file("streets.osm");
  const std::string streets =
      "<osm><node id='1' lat='0' lon='0'/><node id='2' lat='0.001' lon='0'/>"
      "<way id='3'><nd ref='1'/><nd ref='2'/><tag k='highway' v='primary'/></way></osm>\n";
  std::ofstream(other.sd_map.file) << streets;
  const std::string with_streets = maker(other);
  std::ofstream(other.sd_map.file) << streets << "<!-- edited -->\n";
  EXPECT_NE(maker(other), with_streets);
}

}  // namespace
}  // namespace laneloom::service
