#include "doctor/ros2.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "doctor/endpoints.hpp"
#include "doctor/findings.hpp"
#include "laneloom/config.hpp"
#include "laneloom/dds/topics.hpp"
#include "ros2/names.hpp"

namespace laneloom::doctor {
namespace {

using dds::Endpoint;

/// An input of the service from ROS.
struct RosInput {
  std::string what, topic, type;
  std::string key;        ///< key of the configuration that names its topic
  std::string own_topic;  ///< laneloom's own topic for the same input
  bool needed = true;     ///< whether the service maps nothing without it
};

RosInput detections_of(const Ros2Config& ros2) {
  return {"detections", ros2::dds_topic(ros2, ros2::kDetectionsTopic), ros2::dds_type(ros2::kDetectionsType),
          "ros2.namespace", dds::kDetectionsTopic};
}

RosInput poses_of(const Ros2Config& ros2) {
  return {"poses", ros2::dds_topic(ros2, ros2.odometry_topic), ros2::dds_type(ros2::kOdometryType),
          "ros2.odometry_topic", dds::kVehiclePoseTopic};
}

RosInput objects_of(const Ros2Config& ros2) {
  return {"objects",
          ros2::dds_topic(ros2, ros2.objects_topic),
          ros2::dds_type(ros2::kObjectsType),
          "ros2.objects_topic",
          dds::kObjectsTopic,
          false};
}

RosInput next_turns_of(const Ros2Config& ros2) {
  return {"turns",
          ros2::dds_topic(ros2, ros2::kNextTurnTopic),
          ros2::dds_type(ros2::kNextTurnType),
          "ros2.namespace",
          dds::kNextTurnTopic,
          false};
}

/// The section ros2 of the service's configuration. None: there is no service, or it told nothing.
std::optional<Ros2Config> ros2_of(const Observed& seen) {
  if (seen.services.empty()) return std::nullopt;
  Ros2Config ros2;
  for (const auto& [key, value] : seen.services.back().last.configuration) {
    if (key == "ros2.enabled") ros2.enabled = value == "true";
    if (key == "ros2.namespace") ros2.ros_namespace = value;
    if (key == "ros2.odometry_topic") ros2.odometry_topic = value;
    if (key == "ros2.objects_topic") ros2.objects_topic = value;
  }
  return ros2;
}

bool is_written(const Observed& seen, const RosInput& input) {
  return std::ranges::any_of(seen.endpoints, [&](const Endpoint& endpoint) {
    return endpoint.is_writer && endpoint.topic == input.topic && endpoint.type == input.type &&
           partitions_match(endpoint.partitions, {});
  });
}

Finding elsewhere(const Endpoint& endpoint, const RosInput& input) {
  return {"ros_topic",
          fmt::format("{} writes {} ({}), not {}.", who(endpoint.participant), endpoint.topic, endpoint.type,
                      input.topic),
          fmt::format("The service reads {} of ROS 2 from one topic.", input.what),
          fmt::format("If these are the {} of this vehicle, set {}, or remap the topic of the node.",
                      input.what, input.key)};
}

Finding not_enabled(const Endpoint& endpoint) {
  return {"ros_not_enabled",
          fmt::format("{} writes {} as a node of ROS 2, which the service does not read.",
                      who(endpoint.participant), endpoint.topic),
          "Topics of ROS 2 have other names and types than laneloom's own.",
          "Set ros2.enabled: true, and restart the service."};
}

/// Whether laneloom's own topic of an input is written: then odometries in the domain may belong to others.
bool is_written_without_ros(const Observed& seen, const RosInput& input) {
  return std::ranges::any_of(seen.endpoints, [&](const Endpoint& endpoint) {
    return endpoint.is_writer && endpoint.topic == input.own_topic &&
           is_of_vehicle(endpoint, seen.dds.vehicle_id);
  });
}

void judge(const Observed& seen, const Ros2Config& ros2, const RosInput& input, Findings& found) {
  if (is_written_without_ros(seen, input) || (ros2.enabled && is_written(seen, input))) return;
  if (!input.needed && !ros2.enabled) return;
  for (const Endpoint& endpoint : seen.endpoints) {
    if (!endpoint.is_writer || endpoint.type != input.type) continue;
    found.push_back(ros2.enabled ? elsewhere(endpoint, input) : not_enabled(endpoint));
  }
}

}  // namespace

bool ros_writes_detections(const Observed& seen) {
  const auto ros2 = ros2_of(seen);
  return ros2 && ros2->enabled && is_written(seen, detections_of(*ros2));
}

bool ros_writes_poses(const Observed& seen) {
  const auto ros2 = ros2_of(seen);
  return ros2 && ros2->enabled && is_written(seen, poses_of(*ros2));
}

bool ros_writes_objects(const Observed& seen) {
  const auto ros2 = ros2_of(seen);
  return ros2 && ros2->enabled && is_written(seen, objects_of(*ros2));
}

bool ros_writes_next_turns(const Observed& seen) {
  const auto ros2 = ros2_of(seen);
  return ros2 && ros2->enabled && is_written(seen, next_turns_of(*ros2));
}

bool is_of_ros(const Endpoint& endpoint) { return endpoint.type.find("::dds_::") != std::string::npos; }

Findings ros_findings(const Observed& seen) {
  Findings found;
  const auto ros2 = ros2_of(seen);
  if (!ros2) return found;
  judge(seen, *ros2, detections_of(*ros2), found);
  judge(seen, *ros2, poses_of(*ros2), found);
  judge(seen, *ros2, objects_of(*ros2), found);
  judge(seen, *ros2, next_turns_of(*ros2), found);
  return found;
}

}  // namespace laneloom::doctor
