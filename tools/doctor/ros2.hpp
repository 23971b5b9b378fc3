#pragma once

#include "doctor/observed.hpp"

namespace laneloom::doctor {

/// Whether nodes of ROS 2 write the inputs that the service takes from them.
bool ros_writes_detections(const Observed& seen);
bool ros_writes_poses(const Observed& seen);
bool ros_writes_objects(const Observed& seen);
bool ros_writes_next_turns(const Observed& seen);

/// Whether an endpoint belongs to a node of ROS 2, by its type.
bool is_of_ros(const dds::Endpoint& endpoint);

}  // namespace laneloom::doctor
