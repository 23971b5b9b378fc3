#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bytes.hpp"
#include "cdr/random_messages.hpp"
#include "cdr/serialise.hpp"
#include "recording/message_json.hpp"
#include "road.hpp"
#include "ros2/diagnostics.hpp"
#include "ros2/markers.hpp"
#include "ros2/odometry.hpp"
#include "ros2/road_segments.hpp"
#include "ros2/tracked_objects.hpp"
#include "temporary_folder.hpp"

// npm's @foxglove/rosmsg and @foxglove/rosmsg2-serialization share no code with laneloom.
namespace laneloom::ros2 {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

const std::string kFolder = DECODERS_FOLDER;

std::string hex(const Bytes& bytes) {
  std::string text;
  std::array<char, 3> digits{};
  for (const auto byte : bytes) {
    std::snprintf(digits.data(), digits.size(), "%02x", byte);
    text += digits.data();
  }
  return text;
}

Bytes from_hex(const std::string& text) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(text.substr(i, 2), nullptr, 16)));
  return bytes;
}

class Decoders : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder + "/node_modules/@foxglove/rosmsg"))
      GTEST_SKIP() << "the npm registry could not be reached (see the test decoders_install)";
  }

  void write(const std::string& type, const Bytes& bytes, const json& wanted) {
    std::ofstream(cases_, std::ios::app)
        << json{{"type", type}, {"bytes", hex(bytes)}, {"wanted", wanted}} << '\n';
  }
  template <class Message>
  void write_ours(const std::string& type, const Message& message) {
    Bytes bytes;
    dds::serialise(message, bytes);
    Message with_checksum;
    dds::deserialise(bytes, with_checksum);
    write(type, bytes, json_of(with_checksum));
  }
  /// The output of the script, with its errors.
  std::string run(const std::string& arguments) const {
    std::string said;
    FILE* pipe = popen(("node " + kFolder + "/decode.mjs " + arguments + " 2>&1").c_str(), "r");
    std::array<char, 4096> part{};
    while (pipe != nullptr && std::fgets(part.data(), part.size(), pipe) != nullptr) said += part.data();
    if (pipe != nullptr) pclose(pipe);
    return said;
  }
  std::string decode() const { return run(cases_ + " " + LANELOOM_MSGS); }

 private:
  const TemporaryFolder folder_;
  const std::string cases_ = folder_.file("cases.jsonl");
};

TEST_F(Decoders, ReadEveryFieldOfOurMessages) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    dds::RandomMessages random(seed);
    write_ours("laneloom_msgs/Detections", random.detections());
    write_ours("laneloom_msgs/LaneMap", random.lane_map());
  }
  EXPECT_EQ(decode(), "20 messages are as they were written\n");
}

TEST_F(Decoders, ReadMarkersSegmentsAndDiagnostics) {
  PublishedMap map = empty_map();
  map.map.T_map_body = Eigen::Isometry3d::Identity();
  map.map.lanes = {lane_at(1, 0.0, 0.0, 1), lane_at(2, 1.0, 0.0, 1)};
  map.map.linkages = {{1, 2}};
  const json stamp{{"sec", 1'700'000'000}, {"nsec", 250'000'000}};
  const json header{{"stamp", stamp}, {"frame_id", "map"}};
  Markers markers;
  markers.update(map);
  map.map.lanes.pop_back();
  const json lane{{"header", header},
                  {"ns", "lanes"},
                  {"id", 0},
                  {"type", 11},
                  {"action", 0},
                  {"lifetime", {{"sec", 1}, {"nsec", 0}}},
                  {"scale", {{"x", 1}, {"y", 1}, {"z", 1}}}};
  const json state{{"ns", "state"}, {"type", 9}, {"text", "OK"}},
      gone{{"ns", "lanes"}, {"id", 1}, {"action", 2}};
  write("visualization_msgs/MarkerArray", bytes_of(markers.update(map)), {{"markers", {lane, state, gone}}});

  map.map.lanes = {lane_at(1, 0.0, 0.0, 1), lane_at(2, 1.0, 0.0, 1)};
  const auto pose = [](double x, double y) {
    return json{{"position", {{"x", x}, {"y", y}, {"z", 0}}},
                {"orientation", {{"x", 0}, {"y", 0}, {"z", 0}, {"w", 1}}}};
  };
  const auto segment = [&](int id, double x, int next) {
    const json left{{"poses", {pose(x, 2), pose(x + 1, 2)}}},
        right{{"poses", {pose(x, -2), pose(x + 1, -2)}}};
    return json{{"id", id},
                {"linestrings", {left, right}},
                {"successor_segment_id", {next}},
                {"neighboring_segment_id", {-1, -1}}};
  };
  write("autoware_mapless_planning_msgs/RoadSegments", bytes_of(to_road_segments(map)),
        {{"header", {{"stamp", stamp}, {"frame_id", "base_link"}}},
         {"segments", {segment(0, 0, 1), segment(1, 1, -1)}},
         {"pose", pose(0, 0)}});

  ServiceStatus status;
  status.state = MapState::degraded;
  status.reasons = {StateReason::no_poses};
  const json told{{"level", 1},
                  {"name", "/laneloom: lane map"},
                  {"message", "DEGRADED no_poses"},
                  {"hardware_id", "ego"}};
  write("diagnostic_msgs/DiagnosticArray", bytes_of(to_diagnostics(status, "/laneloom", "ego")),
        {{"status", json::array({told})}});
  EXPECT_EQ(decode(), "3 messages are as they were written\n");
}

// The comparison itself: one field that differs is found.
TEST_F(Decoders, FindAFieldThatDiffers) {
  write("diagnostic_msgs/DiagnosticArray", bytes_of(to_diagnostics({}, "/laneloom", "ego")),
        {{"status", json::array({{{"name", "/laneloom: lane map"}, {"level", 2}}})}});
  EXPECT_NE(decode().find("level: 3, not 2"), std::string::npos) << decode();
}

TEST_F(Decoders, WriteAnOdometryThatIsRead) {
  const Bytes bytes = from_hex(run("--odometry"));
  ASSERT_TRUE(is_odometry(bytes));
  nav_msgs::msg::dds_::Odometry_ message;
  dds::read_cdr(bytes, [&](eprosima::fastcdr::Cdr& cdr) { cdr >> message; });
  VehiclePose pose;
  EXPECT_EQ(from_ros(message, "map", pose), "");
  EXPECT_EQ(pose.stamp_ns, 1'700'000'000'250'000'000);
  EXPECT_EQ(pose.position, Point(1.0, 2.0, 3.0));
  EXPECT_EQ(message.child_frame_id(), "base_link");
  EXPECT_EQ(message.twist().twist().angular().z(), 9.0);
  EXPECT_EQ(message.twist().covariance()[35], 0.25);
}

TEST_F(Decoders, WriteTrackedObjectsThatAreRead) {
  const Bytes bytes = from_hex(run("--objects"));
  ASSERT_TRUE(is_tracked_objects(bytes));
  autoware_perception_msgs::msg::dds_::TrackedObjects_ message;
  dds::read_cdr(bytes, [&](eprosima::fastcdr::Cdr& cdr) { cdr >> message; });
  TrackedObjects objects;
  EXPECT_EQ(from_ros(message, "map", objects), "");
  EXPECT_EQ(objects.stamp_ns, 1'700'000'000'250'000'000);
  ASSERT_EQ(objects.objects.size(), 2U);
  const TrackedObject& bus = objects.objects[1];
  EXPECT_NE(bus.id, objects.objects[0].id);
  EXPECT_EQ(bus.kind, ObjectKind::bus);
  EXPECT_EQ(bus.existence_probability, 0.5);
  EXPECT_EQ(bus.position, Point(1.0, 2.0, 1.5));
  EXPECT_EQ(bus.heading, Point::UnitX());
  EXPECT_EQ(bus.speed_mps, 4.0);
  EXPECT_EQ(bus.position_stddev_m, 0.5);
  EXPECT_EQ(bus.length_m, 12.0);
  EXPECT_EQ(bus.width_m, 2.5);
  EXPECT_EQ(message.objects()[1].kinematics().acceleration_with_covariance().covariance()[35], 0.125);
  EXPECT_EQ(message.objects()[1].shape().footprint().points().at(1).y(), 6.0F);
}

}  // namespace
}  // namespace laneloom::ros2
