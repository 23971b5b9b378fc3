#pragma once

#include <string>
#include <string_view>

#include "dds/topic_traits.hpp"
#include "ros2/names.hpp"

namespace laneloom::ros2 {

/// The topic `name` of a node. ROS knows its type as `ros_type`; `Type` is the type support of its samples.
template <class Type>
dds::TopicDescription topic(const std::string& name, std::string_view ros_type, dds::TopicKind kind) {
  auto* type = new Type;
  dds::announce_as(dds_type(ros_type), *type);
  return {name, kind, eprosima::fastdds::dds::TypeSupport(type), user_data(ros_type)};
}

/// Likewise; `name` is below the namespace of `config` if it has no leading '/'.
template <class Type>
dds::TopicDescription topic(const Ros2Config& config, const std::string& name, std::string_view ros_type,
                            dds::TopicKind kind) {
  return topic<Type>(dds_topic(config, name), ros_type, kind);
}

}  // namespace laneloom::ros2
