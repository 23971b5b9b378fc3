#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "cdr/layout.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"

/// Conversion between plain types and messages. `map_frame_id` is the frame that poses are in.
namespace laneloom::dds {

/// Each returns how many elements were left out because they exceed the bounds of the IDL, or refer to an
/// element that does. A name that is cut counts as one.
std::size_t to_msg(const DetectionFrame& from, const std::string& map_frame_id, msg::Detections& to);
std::size_t to_msg(const VehiclePose& from, const std::string& map_frame_id, msg::VehiclePose& to);
std::size_t to_msg(const TrackedObjects& from, const std::string& map_frame_id, msg::Objects& to);
std::size_t to_msg(const NextTurn& from, const std::string& map_frame_id, msg::NextTurn& to);
std::size_t to_msg(const PublishedMap& from, const std::string& map_frame_id, msg::LaneMap& to);
std::size_t to_msg(const RoadMarkings& from, const std::string& map_frame_id, msg::RoadMarkings& to);
std::size_t to_msg(const ServiceStatus& from, const std::string& map_frame_id, msg::ServiceStatus& to);

/// The reason why a message is refused, as a stable name. Empty: it is not refused.
using Refusal = std::string_view;

/// Each checks numbers, enumerations, rotations and sizes. `to` is only valid if the message is not refused.
/// Each detection of a frame is freed as soon as it is converted: a large frame is not held twice.
Refusal from_msg(msg::Detections&& from, const std::string& map_frame_id, DetectionFrame& to);
Refusal from_msg(const msg::VehiclePose& from, const std::string& map_frame_id, VehiclePose& to);
Refusal from_msg(const msg::Objects& from, const std::string& map_frame_id, TrackedObjects& to);
Refusal from_msg(const msg::NextTurn& from, const std::string& map_frame_id, NextTurn& to);
Refusal from_msg(const msg::LaneMap& from, const std::string& map_frame_id, PublishedMap& to);
Refusal from_msg(const msg::RoadMarkings& from, const std::string& map_frame_id, RoadMarkings& to);
Refusal from_msg(const msg::ServiceStatus& from, const std::string& map_frame_id, ServiceStatus& to);

}  // namespace laneloom::dds
