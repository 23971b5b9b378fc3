#pragma once

namespace laneloom {

/// The names of the vehicle's frame in messages: laneloom's own one, and that of ROS.
inline constexpr const char *kBodyFrame = "body", *kBaseLink = "base_link";

}  // namespace laneloom
