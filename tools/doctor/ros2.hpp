#pragma once

#include "doctor/observed.hpp"

namespace laneloom {

/// Whether nodes of ROS 2 write what the service takes from them.
bool ros_writes_detections(const Observed& seen);
bool ros_writes_poses(const Observed& seen);

/// Whether it is a node's, by its type.
bool is_of_ros(const dds::Endpoint& endpoint);

}  // namespace laneloom
