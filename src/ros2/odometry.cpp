#include "ros2/odometry.hpp"

#include "ros2/input_parts.hpp"

namespace laneloom::ros2 {

bool is_odometry(std::span<const std::uint8_t> payload) {
  dds::CdrScanner cdr(payload);
  scan_header(cdr);
  scan_text(cdr);
  cdr.numbers(sizeof(double), 7 + kCovariance);
  cdr.numbers(sizeof(double), 6 + kCovariance);
  return cdr.complete();
}

std::string_view from_ros(const nav_msgs::msg::dds_::Odometry_& from, const std::string& map_frame_id,
                          VehiclePose& to) {
  dds::Intake intake;
  to.stamp_ns = stamp_of(from.header(), intake);
  if (from.header().frame_id() != map_frame_id) intake.refuse("wrong_frame");
  to.position = point_of(from.pose().pose().position(), intake);
  to.orientation = rotation_of(from.pose().pose().orientation(), intake);
  return intake.refusal();
}

}  // namespace laneloom::ros2
