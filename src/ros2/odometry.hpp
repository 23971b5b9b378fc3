#pragma once

#include <span>
#include <string>
#include <string_view>

#include "NavMsgs.hpp"
#include "laneloom/types.hpp"

namespace laneloom::ros2 {

/// Whether `payload` can be an Odometry: each length is within the payload.
bool is_odometry(std::span<const std::uint8_t> payload);

/// Takes the pose of an odometry, which must be in `map_frame_id`. Session and sequence of `to` stay
/// unchanged. Returns why it is refused, by the names of cdr/convert.hpp; empty: it is not refused.
/// Covariances and the twist are ignored.
std::string_view from_ros(const nav_msgs::msg::dds_::Odometry_& from, const std::string& map_frame_id,
                          VehiclePose& to);

}  // namespace laneloom::ros2
