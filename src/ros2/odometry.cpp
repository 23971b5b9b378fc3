#include "ros2/odometry.hpp"

#include "cdr/cdr_scanner.hpp"
#include "cdr/intake.hpp"

namespace laneloom::ros2 {
namespace {

constexpr std::size_t kMaxName = 4096;  // of a frame; far longer than any real one
constexpr std::size_t kCovariance = 36;
constexpr std::uint32_t kNanosecondsPerSecond = 1'000'000'000;

}  // namespace

bool is_odometry(std::span<const std::uint8_t> payload) {
  dds::CdrScanner cdr(payload);
  cdr.numbers(sizeof(std::uint32_t), 2);
  cdr.text(kMaxName);
  cdr.text(kMaxName);
  cdr.numbers(sizeof(double), 7 + kCovariance);
  cdr.numbers(sizeof(double), 6 + kCovariance);
  return cdr.complete();
}

std::string_view from_ros(const nav_msgs::msg::dds_::Odometry_& from, const std::string& map_frame_id,
                          VehiclePose& to) {
  dds::Intake intake;
  const auto& stamp = from.header().stamp();
  if (stamp.nanosec() >= kNanosecondsPerSecond) intake.refuse("stamp");
  to.stamp_ns = std::int64_t{stamp.sec()} * kNanosecondsPerSecond + stamp.nanosec();
  if (from.header().frame_id() != map_frame_id) intake.refuse("wrong_frame");
  const auto& position = from.pose().pose().position();
  to.position = {intake.number(position.x()), intake.number(position.y()), intake.number(position.z())};
  const auto& orientation = from.pose().pose().orientation();
  msg::Quaternion rotation;
  rotation.x(orientation.x());
  rotation.y(orientation.y());
  rotation.z(orientation.z());
  rotation.w(orientation.w());
  to.orientation = intake.rotation(rotation);
  return intake.refusal();
}

}  // namespace laneloom::ros2
