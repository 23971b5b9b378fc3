#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

#include "GeometryMsgs.hpp"
#include "StdMsgs.hpp"
#include "laneloom/types.hpp"

/// Parts that several messages of ROS share.
namespace laneloom::ros2 {

inline builtin_interfaces::msg::dds_::Time_ to_time(std::int64_t stamp_ns) {
  builtin_interfaces::msg::dds_::Time_ to;
  to.sec(static_cast<std::int32_t>(stamp_ns / 1'000'000'000));
  to.nanosec(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
  return to;
}

inline std_msgs::msg::dds_::Header_ to_header(std::int64_t stamp_ns, const std::string& frame_id) {
  std_msgs::msg::dds_::Header_ to;
  to.stamp(to_time(stamp_ns));
  to.frame_id(frame_id);
  return to;
}

inline geometry_msgs::msg::dds_::Point_ to_point(const Point& from) {
  geometry_msgs::msg::dds_::Point_ to;
  to.x(from.x());
  to.y(from.y());
  to.z(from.z());
  return to;
}

inline geometry_msgs::msg::dds_::Pose_ to_pose(const Point& position, const Eigen::Quaterniond& orientation) {
  geometry_msgs::msg::dds_::Pose_ to;
  to.position(to_point(position));
  to.orientation().x(orientation.x());
  to.orientation().y(orientation.y());
  to.orientation().z(orientation.z());
  to.orientation().w(orientation.w());
  return to;
}

}  // namespace laneloom::ros2
