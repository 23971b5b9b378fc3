#pragma once

#include <cstddef>
#include <cstdint>

#include "GeometryMsgs.hpp"
#include "StdMsgs.hpp"
#include "cdr/cdr_scanner.hpp"
#include "cdr/intake.hpp"
#include "laneloom/types.hpp"

/// Parts that several messages from nodes of ROS share. What is wrong with a part, the intake is told.
namespace laneloom::ros2 {

inline constexpr std::size_t kCovariance = 36;  ///< length of a covariance

/// Skips a string.
inline void scan_text(dds::CdrScanner& cdr) {
  cdr.text(4096);  // far longer than any real one
}

/// Skips a header.
inline void scan_header(dds::CdrScanner& cdr) {
  cdr.numbers(sizeof(std::uint32_t), 2);
  scan_text(cdr);
}

inline std::int64_t stamp_of(const std_msgs::msg::dds_::Header_& header, dds::Intake& intake) {
  constexpr std::uint32_t kNanosecondsPerSecond = 1'000'000'000;
  if (header.stamp().nanosec() >= kNanosecondsPerSecond) intake.refuse("stamp");
  return std::int64_t{header.stamp().sec()} * kNanosecondsPerSecond + header.stamp().nanosec();
}

inline Point point_of(const geometry_msgs::msg::dds_::Point_& from, dds::Intake& intake) {
  return {intake.number(from.x()), intake.number(from.y()), intake.number(from.z())};
}

inline Eigen::Quaterniond rotation_of(const geometry_msgs::msg::dds_::Quaternion_& from,
                                      dds::Intake& intake) {
  msg::Quaternion rotation;
  rotation.x(from.x());
  rotation.y(from.y());
  rotation.z(from.z());
  rotation.w(from.w());
  return intake.rotation(rotation);
}

}  // namespace laneloom::ros2
