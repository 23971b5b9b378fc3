#include "laneloom/dds/topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "doctor/endpoints.hpp"
#include "doctor/findings.hpp"
#include "doctor/ros2.hpp"

namespace laneloom::doctor {
namespace {

using dds::Endpoint;

struct Topic {
  const char* id;
  const char* what;
  const char* name;
  const char* type;
  bool input;                                     ///< whether it is an input of the service
  bool needed;                                    ///< an input without which the service maps nothing
  bool (*ros_writes)(const Observed&) = nullptr;  ///< whether nodes of ROS 2 write it
};

constexpr std::array kTopics{
    Topic{"detections", "detections", dds::kDetectionsTopic, dds::kDetectionsType, true, true,
          ros_writes_detections},
    Topic{"poses", "poses", dds::kVehiclePoseTopic, dds::kVehiclePoseType, true, true, ros_writes_poses},
    Topic{"objects", "objects", dds::kObjectsTopic, dds::kObjectsType, true, false, ros_writes_objects},
    Topic{"next_turn", "the next turn", dds::kNextTurnTopic, dds::kNextTurnType, true, false,
          ros_writes_next_turns},
    Topic{"lane_map", "the lane map", dds::kLaneMapTopic, dds::kLaneMapType, false, false},
    Topic{"road_markings", "the road markings", dds::kRoadMarkingsTopic, dds::kRoadMarkingsType, false,
          false}};

/// The essence of a topic's name: without case, separators, version, and prefixes that bridges add.
std::string heart(const std::string& topic) {
  std::string result, part;
  std::istringstream parts(topic);
  while (std::getline(parts, part, '/')) {
    std::erase_if(part, [](unsigned char c) { return std::isalnum(c) == 0; });
    std::ranges::transform(part, part.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool version =
        part.size() > 1 && part[0] == 'v' &&
        std::all_of(part.begin() + 1, part.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    if (!version && part != "rt" && part != "laneloom") result += part;
  }
  return result;
}

/// Whether an endpoint is on the other side than the service: a writer of an input, or a reader of an output.
bool is_at_far_end(const Endpoint& endpoint, const Topic& topic) { return endpoint.is_writer == topic.input; }

const char* verb(const Topic& topic) { return topic.input ? "writes" : "reads"; }

/// Whether an endpoint at the far end matches the service of this vehicle, apart from its quality of service.
bool is_right(const Endpoint& endpoint, const Topic& topic, const std::string& vehicle_id) {
  return is_at_far_end(endpoint, topic) && endpoint.topic == topic.name && endpoint.type == topic.type &&
         is_of_vehicle(endpoint, vehicle_id);
}

Finding nobody_writes(const Observed& seen, const Topic& topic) {
  return {
      fmt::format("no_{}", topic.id),
      fmt::format(R"(Nobody writes {} for vehicle "{}" (topic {}, type {}, partition "{}", domain {}).{})",
                  topic.what, seen.dds.vehicle_id, topic.name, topic.type, seen.dds.vehicle_id,
                  seen.dds.domain, elsewhere(seen)),
      "The service maps nothing without detections and poses, both of the same vehicle.",
      "Start what writes them, in this domain and partition."};
}

Finding wrong_type(const Endpoint& endpoint, const Topic& topic) {
  return {"wrong_type",
          fmt::format("{} {} {} with the type {}, not {}.", who(endpoint.participant),
                      endpoint.is_writer ? "writes" : "reads", topic.name, endpoint.type, topic.type),
          "Writers and readers with different type names never match.",
          "Generate its types from the IDL files of laneloom, and keep the name that they give."};
}

Finding similar_name(const Endpoint& endpoint, const Topic& topic) {
  return {"similar_topic",
          fmt::format("{} {} the topic {}, not {}.", who(endpoint.participant), verb(topic), endpoint.topic,
                      topic.name),
          "Topics match by their whole name, version and case included, with no prefix.",
          fmt::format("If these are {} of laneloom, name the topic {}.", topic.what, topic.name)};
}

Finding wrong_partition(const Observed& seen, const Endpoint& endpoint, const Topic& topic) {
  return {"wrong_partition",
          fmt::format("{} {} {} in {}, not \"{}\".", who(endpoint.participant), verb(topic), topic.what,
                      partitions_text(endpoint.partitions), seen.dds.vehicle_id),
          "Each vehicle has a partition of its own, named by its id; nothing crosses over.",
          fmt::format("If it belongs to this vehicle, set its partition to \"{}\" (dds.vehicle_id, "
                      "--vehicle-id).",
                      seen.dds.vehicle_id)};
}

/// Whether a service of some vehicle is at the other end.
bool is_served(const Observed& seen, const Endpoint& endpoint) {
  const auto all = services(seen);
  return std::ranges::any_of(all, [&](const Endpoint& service) {
    return partitions_match(service.partitions, endpoint.partitions);
  });
}

void judge(const Observed& seen, const Topic& topic, Findings& found) {
  const std::string& vehicle_id = seen.dds.vehicle_id;
  const bool connected =
      std::ranges::any_of(seen.endpoints,
                          [&](const Endpoint& endpoint) { return is_right(endpoint, topic, vehicle_id); }) ||
      (topic.ros_writes != nullptr && topic.ros_writes(seen));
  for (const Endpoint& endpoint : seen.endpoints) {
    const bool of_vehicle = is_of_vehicle(endpoint, vehicle_id);
    if (endpoint.topic == topic.name) {
      if (of_vehicle && endpoint.type != topic.type) found.push_back(wrong_type(endpoint, topic));
      if (!of_vehicle && !connected && is_at_far_end(endpoint, topic) &&
          (topic.input || !is_served(seen, endpoint))) {
        found.push_back(wrong_partition(seen, endpoint, topic));
      }
    } else if (!connected && !is_of_ros(endpoint) && is_at_far_end(endpoint, topic) &&
               heart(endpoint.topic) == heart(topic.name)) {
      found.push_back(similar_name(endpoint, topic));
    }
  }
  // This comes last, since findings on other endpoints are the cause.
  if (topic.needed && !connected) found.push_back(nobody_writes(seen, topic));
}

}  // namespace

Findings topic_findings(const Observed& seen) {
  Findings found;
  for (const Topic& topic : kTopics) judge(seen, topic, found);
  return found;
}

}  // namespace laneloom::doctor
