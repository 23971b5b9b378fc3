#include "ros2/names.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace laneloom::ros2 {
namespace {

TEST(Names, AreMangledAsRosDoes) {
  Ros2Config config;
  EXPECT_EQ(dds_topic(config, "odom"), "rt/odom");
  EXPECT_EQ(full_node_name(config), "/laneloom");
  for (const char* name : {"/fleet/car_1", "fleet/car_1"}) {
    config.ros_namespace = name;
    EXPECT_EQ(full_namespace(config), "/fleet/car_1");
    EXPECT_EQ(full_node_name(config), "/fleet/car_1/laneloom");
    EXPECT_EQ(dds_topic(config, "laneloom/lane_map"), "rt/fleet/car_1/laneloom/lane_map");
    EXPECT_EQ(dds_topic(config, "/diagnostics"), "rt/diagnostics");
  }
  EXPECT_EQ(dds_type("nav_msgs/msg/Odometry"), "nav_msgs::msg::dds_::Odometry_");
}

// These are the hashes that rosidl's own generator gives for the .msg files of Jazzy.
TEST(TypeHashes, AreThoseOfRos) {
  const auto hash = [](const char* type) { return user_data(type); };
  EXPECT_EQ(hash("nav_msgs/msg/Odometry"),
            "typehash=RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0;");
  EXPECT_EQ(hash("visualization_msgs/msg/MarkerArray"),
            "typehash=RIHS01_86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf;");
  EXPECT_EQ(hash("diagnostic_msgs/msg/DiagnosticArray"),
            "typehash=RIHS01_5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e;");
  EXPECT_EQ(hash("autoware_mapless_planning_msgs/msg/RoadSegments"),
            "typehash=RIHS01_61e98577e4de1fd1307e9bdfc809000f99d188c35ed507fe6aa575f5a0445352;");
  EXPECT_EQ(hash("autoware_perception_msgs/msg/TrackedObjects"),
            "typehash=RIHS01_3559bd4e62ce8a4d96e32720c02bbe656cc090bb2b3f3f91f52a7c3ab095417a;");
  EXPECT_EQ(hash("rmw_dds_common/msg/ParticipantEntitiesInfo"),
            "typehash=RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e;");
  for (const char* ours :
       {"laneloom_msgs/msg/Detections", "laneloom_msgs/msg/NextTurn", "laneloom_msgs/msg/LaneMap"})
    EXPECT_EQ(hash(ours).size(), hash("nav_msgs/msg/Odometry").size());
  EXPECT_THROW(hash("nav_msgs/msg/Path"), std::out_of_range);
}

TEST(Sessions, DifferByWriterAndAreNeverZero) {
  dds::WriterId one{}, other{};
  other[15] = 1;
  EXPECT_NE(session_of(one), 0U);
  EXPECT_NE(session_of(one), session_of(other));
  EXPECT_EQ(session_of(one), session_of(one));
}

}  // namespace
}  // namespace laneloom::ros2
