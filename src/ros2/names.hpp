#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "laneloom/config.hpp"
#include "laneloom/dds/reader.hpp"

/// The names on DDS that ROS 2 gives to topics and types. All functions are pure.
namespace laneloom::ros2 {

/// The name of the service as a node.
inline constexpr const char* kNodeName = "laneloom";

/// Topic (in the namespace) and type of the frames of detections.
inline constexpr const char* kDetectionsTopic = "laneloom/detections";
inline constexpr const char* kDetectionsType = "laneloom_msgs/msg/Detections";
/// Topic (in the namespace) and type of the route's next turn.
inline constexpr const char* kNextTurnTopic = "laneloom/next_turn";
inline constexpr const char* kNextTurnType = "laneloom_msgs/msg/NextTurn";
/// Type of the poses. The configuration names their topic.
inline constexpr const char* kOdometryType = "nav_msgs/msg/Odometry";
/// Type of the tracked objects. The configuration names their topic.
inline constexpr const char* kObjectsType = "autoware_perception_msgs/msg/TrackedObjects";

/// The namespace with its leading '/'; "/" if there is none.
std::string full_namespace(const Ros2Config& config);
/// The node with its namespace: "/car_1/laneloom".
std::string full_node_name(const Ros2Config& config);

/// The DDS topic of a ROS topic: "rt/car_1/odom" for "odom" in "/car_1". A name with a leading '/' is not
/// below the namespace.
std::string dds_topic(const Ros2Config& config, const std::string& name);

/// The DDS type of a ROS type: "nav_msgs::msg::dds_::Odometry_" for "nav_msgs/msg/Odometry".
std::string dds_type(std::string_view ros_type);

/// The user data of an endpoint of a ROS type: "typehash=RIHS01_…;". Throws std::out_of_range for a type that
/// idl/ does not have.
std::string user_data(std::string_view ros_type);

/// The user data of a participant of ROS. It names the security enclave that the participant belongs to.
inline constexpr const char* kParticipantUserData = "enclave=/;";

/// A session id for a writer whose messages name none: a different one for each writer, never 0.
std::uint64_t session_of(const dds::WriterId& writer);

}  // namespace laneloom::ros2
