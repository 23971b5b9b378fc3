#include <gtest/gtest.h>

#include "scenes.hpp"

namespace laneloom::doctor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kOdometry = "nav_msgs::msg::dds_::Odometry_";
constexpr const char* kObjects = "autoware_perception_msgs::msg::dds_::TrackedObjects_";
constexpr const char* kRosDetections = "laneloom_msgs::msg::dds_::Detections_";

dds::Endpoint node(bool is_writer, const char* topic, const char* type) {
  dds::Endpoint result = endpoint(is_writer, "node", topic, type);
  result.partitions = {};
  return result;
}

/// A service for nodes in /car_1, and nodes that write both inputs.
Observed with_nodes() {
  Observed seen = healthy();
  std::erase_if(seen.endpoints,
                [](const dds::Endpoint& each) { return each.is_writer && each.topic != dds::kLaneMapTopic; });
  seen.endpoints.push_back(node(true, "rt/car_1/odom", kOdometry));
  seen.endpoints.push_back(node(true, "rt/car_1/laneloom/detections", kRosDetections));
  seen.services[0].last.configuration = {
      {"ros2.enabled", "true"}, {"ros2.namespace", "/car_1"}, {"ros2.odometry_topic", "odom"}};
  return seen;
}

TEST(Ros2, NodesThatWriteTheInputsAreEnough) {
  const Observed seen = with_nodes();
  EXPECT_THAT(ids(topic_findings(seen)), IsEmpty());
  EXPECT_THAT(ids(ros_findings(seen)), IsEmpty());
}

TEST(Ros2, ANodeThatReadsTheMapHasNoSimilarName) {
  Observed seen = with_nodes();
  std::erase_if(seen.endpoints, [](const dds::Endpoint& each) {
    return !each.is_writer && each.topic == dds::kLaneMapTopic;
  });
  seen.endpoints.push_back(node(false, "rt/car_1/laneloom/lane_map", "laneloom_msgs::msg::dds_::LaneMap_"));
  EXPECT_THAT(ids(topic_findings(seen)), IsEmpty());
}

TEST(Ros2, AnotherTopic) {
  Observed seen = with_nodes();
  seen.services[0].last.configuration[2].second = "/localization/kinematic_state";
  EXPECT_THAT(ids(topic_findings(seen)), ElementsAre("no_poses"));
  const Findings found = ros_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("ros_topic"));
  EXPECT_THAT(found[0].found, HasSubstr("rt/car_1/odom"));
  EXPECT_THAT(found[0].found, HasSubstr("not rt/localization/kinematic_state"));
  EXPECT_THAT(found[0].remedy, HasSubstr("ros2.odometry_topic"));
}

TEST(Ros2, ObjectsOfAnotherTopic) {
  Observed seen = with_nodes();
  seen.endpoints.push_back(node(true, "rt/perception/objects", kObjects));
  const Findings found = ros_findings(seen);
  ASSERT_THAT(ids(found), ElementsAre("ros_topic"));
  EXPECT_THAT(found[0].remedy, HasSubstr("ros2.objects_topic"));
  seen.services[0].last.configuration.emplace_back("ros2.objects_topic", "/perception/objects");
  EXPECT_THAT(ids(ros_findings(seen)), IsEmpty());
}

TEST(Ros2, ObjectsAreOptional) {
  Observed seen = healthy();
  seen.services[0].last.configuration = {{"ros2.enabled", "false"}};
  seen.endpoints.push_back(node(true, "rt/perception/objects", kObjects));
  EXPECT_THAT(ids(ros_findings(seen)), IsEmpty());
}

TEST(Ros2, TheServiceTellsHowOftenNodesWrite) {
  Observed seen = with_nodes();
  seen.detections = seen.poses = {};
  seen.sources.clear();
  const auto found_at = [&](std::uint64_t detections, std::uint64_t poses, std::uint64_t objects) {
    ServiceStatus& last = seen.services[0].last;
    last.published_ns = seen.services[0].first.published_ns + 2'000'000'000;
    last.counters = {
        {"detections_received", detections}, {"poses_received", poses}, {"objects_received", objects}};
    return ids(stream_findings(seen));
  };
  EXPECT_THAT(found_at(7, 39, 0), IsEmpty()) << "nobody writes objects";
  EXPECT_THAT(found_at(6, 38, 0), ElementsAre("detections_slow", "poses_slow"));
  seen.endpoints.push_back(node(true, "rt/perception/objects", kObjects));
  seen.services[0].last.configuration.emplace_back("ros2.objects_topic", "/perception/objects");
  EXPECT_THAT(found_at(8, 40, 4), IsEmpty());
  EXPECT_THAT(found_at(8, 40, 2), ElementsAre("objects_slow"));
  EXPECT_EQ(stream_findings(seen)[0].found, "1.0 objects come in a second; it should be 2 at least.");
  EXPECT_THAT(found_at(8, 40, 0), ElementsAre("objects_slow"));
  seen.services[0].first.published_ns += 1'500'000'000;
  EXPECT_THAT(ids(stream_findings(seen)), IsEmpty()) << "too early to tell";
}

TEST(Ros2, NotEnabled) {
  Observed seen = with_nodes();
  seen.services[0].last.configuration[0].second = "false";
  EXPECT_THAT(ids(topic_findings(seen)), ElementsAre("no_detections", "no_poses"));
  EXPECT_THAT(ids(ros_findings(seen)), ElementsAre("ros_not_enabled", "ros_not_enabled"));
}

TEST(Ros2, ServicesThatTakeTheirOwnTopicsNeedNoNodes) {
  EXPECT_THAT(ids(ros_findings(healthy())), IsEmpty());
  Observed seen = healthy();
  seen.endpoints.push_back(node(true, "rt/wheels/odom", kOdometry));
  EXPECT_THAT(ids(ros_findings(seen)), IsEmpty());
}

}  // namespace
}  // namespace laneloom::doctor
