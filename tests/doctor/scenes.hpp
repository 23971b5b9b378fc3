#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "doctor/findings.hpp"
#include "laneloom/dds/topics.hpp"

/// Observations of a doctor, put together by hand.
namespace laneloom {

inline dds::Endpoint endpoint(bool is_writer, const char* name, const char* topic, const char* type) {
  dds::Endpoint result;
  result.is_writer = is_writer;
  result.participant = {name, name, "10.0.0.1"};
  result.topic = topic;
  result.type = type;
  result.partitions = {"ego"};
  return result;
}

inline dds::Endpoint detections_writer() {
  return endpoint(true, "perception", dds::kDetectionsTopic, dds::kDetectionsType);
}
inline dds::Endpoint pose_writer() {
  return endpoint(true, "odometry", dds::kVehiclePoseTopic, dds::kVehiclePoseType);
}
inline dds::Endpoint map_writer() {
  dds::Endpoint result = endpoint(true, "laneloomd", dds::kLaneMapTopic, dds::kLaneMapType);
  result.reliable = true;
  result.durability = dds::Durability::transient_local;
  result.deadline_s = 0.25;
  result.liveliness = dds::Liveliness::manual_by_topic;
  result.lease_s = 0.4;
  return result;
}
inline dds::Endpoint map_reader() {
  return endpoint(false, "planner", dds::kLaneMapTopic, dds::kLaneMapType);
}

/// Service, perception, odometry and planner of the vehicle "ego", all well, watched for 3 s.
inline doctor::Observed healthy() {
  doctor::Observed seen;
  seen.dds.domain = 3;
  seen.dds.vehicle_id = "ego";
  seen.duration_s = 3.0;
  seen.endpoints = {map_writer(),
                    detections_writer(),
                    pose_writer(),
                    map_reader(),
                    endpoint(false, "laneloomd", dds::kDetectionsTopic, dds::kDetectionsType),
                    endpoint(false, "laneloomd", dds::kVehiclePoseTopic, dds::kVehiclePoseType)};
  for (const auto& each : seen.endpoints) seen.participants.push_back(each.participant);
  seen.listening_domains = {3};
  seen.detections = {.messages = 26, .window_s = 2.5, .newest = {{50'000'000'000, 2'000'000'000}}};
  seen.sources = {{"camera", seen.detections}};
  seen.poses = {.messages = 251, .window_s = 2.5, .newest = {{50'100'000'000, 2'010'000'000}}};
  ServiceStatus status;
  status.session_id = 1;
  status.state = MapState::ok;
  status.counters = {{"frames_fused", 10}, {"poses_lost", 2}, {"detections_refused_late", 3}};
  seen.services = {{status, status, 0.001, 3}};
  return seen;
}

inline std::vector<std::string> ids(const doctor::Findings& found) {
  std::vector<std::string> result;
  for (const doctor::Finding& finding : found) result.push_back(finding.id);
  return result;
}

}  // namespace laneloom
