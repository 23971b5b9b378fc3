#include "cdr/convert_parts.hpp"

#include "base/unit_rotation.hpp"

namespace laneloom::dds {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;

}  // namespace

std::int64_t Intake::stamp_before(double age_s) {
  const double age_ns = age_s * kNanosecondsPerSecond;
  std::int64_t before_ns = 0;
  // The conversion to an integer is defined for finite ages within a century. The stamp may have any value.
  const bool defined = std::abs(age_ns) <= 3.2e18;
  if (!defined || __builtin_sub_overflow(stamp_ns_, std::llround(age_ns), &before_ns)) refuse("not_finite");
  return before_ns;
}

Point Intake::point(const msg::Point& from) { return {number(from.x()), number(from.y()), number(from.z())}; }

Eigen::Quaterniond Intake::rotation(const msg::Quaternion& from) {
  const Eigen::Quaterniond q(number(from.w()), number(from.x()), number(from.y()), number(from.z()));
  if (!is_unit(q)) {
    refuse("not_a_rotation");
    return Eigen::Quaterniond::Identity();
  }
  return q.normalized();
}

std::string beginning(const std::string& text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  const auto goes_on = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; };
  while (bytes > 0 && goes_on(text[bytes])) --bytes;
  return text.substr(0, bytes);
}

msg::Pose pose_to_msg(const Point& position, const Eigen::Quaterniond& orientation) {
  msg::Pose to;
  ToMessage::put(position, to.position());
  to.orientation().w(orientation.w());
  to.orientation().x(orientation.x());
  to.orientation().y(orientation.y());
  to.orientation().z(orientation.z());
  return to;
}

msg::Header header_to_msg(std::int64_t stamp_ns, std::uint64_t sequence, std::uint64_t session_id,
                          const std::string& frame_id) {
  msg::Header to;
  to.stamp_ns(stamp_ns);
  to.sequence_number(sequence);
  to.session_id(session_id);
  ToMessage().put(frame_id, to.frame_id());
  return to;
}

}  // namespace laneloom::dds
