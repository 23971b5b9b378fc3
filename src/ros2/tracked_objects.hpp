#pragma once

#include <span>
#include <string>
#include <string_view>

#include "AutowarePerceptionMsgs.hpp"
#include "laneloom/objects.hpp"

namespace laneloom::ros2 {

/// Whether `payload` can be TrackedObjects: each length is within the payload and within the bounds of
/// idl/Objects.idl.
bool is_tracked_objects(std::span<const std::uint8_t> payload);

/// Takes objects as Autoware's trackers give them, which must be in `map_frame_id` or in the vehicle's frame
/// (kBaseLink). Session and sequence of `to` stay unchanged. Returns why they are refused, by the names of
/// cdr/convert.hpp; empty: they are not refused. A class that laneloom does not have is ObjectKind::unknown;
/// a variance or a dimension that cannot be one is not known.
std::string_view from_ros(const autoware_perception_msgs::msg::dds_::TrackedObjects_& from,
                          const std::string& map_frame_id, TrackedObjects& to);

}  // namespace laneloom::ros2
