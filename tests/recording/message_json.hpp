#pragma once

#include <nlohmann/json.hpp>

#include "cdr/layout.hpp"

/// Messages field by field, for a reader that shares no code with ours to compare with. Numbers of 64 bits
/// are texts, as JSON's readers round them.
namespace laneloom {

nlohmann::json json_of(const msg::Detections& message);
nlohmann::json json_of(const msg::VehiclePose& message);
nlohmann::json json_of(const msg::Objects& message);
nlohmann::json json_of(const msg::NextTurn& message);
nlohmann::json json_of(const msg::LaneMap& message);
nlohmann::json json_of(const msg::RoadMarkings& message);
nlohmann::json json_of(const msg::ServiceStatus& message);

}  // namespace laneloom
