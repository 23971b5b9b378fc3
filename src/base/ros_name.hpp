#pragma once

#include <string>

#include "laneloom/config.hpp"

namespace laneloom {

/// A name of ROS 2 with its namespace, and a leading '/'.
inline std::string full_ros_name(const Ros2Config& config, const std::string& name) {
  if (name.starts_with('/')) return name;
  const std::string& outer = config.ros_namespace;
  const bool is_root = outer.empty() || outer == "/";
  return (outer.starts_with('/') ? "" : "/") + outer + (is_root ? "" : "/") + name;
}

}  // namespace laneloom
