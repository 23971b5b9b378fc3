#include "cdr/convert_parts.hpp"

#include "base/unit_rotation.hpp"

namespace laneloom::dds {
namespace {

constexpr double kNanosecondsPerSecond = 1e9;

/// The stamp that was `age_s` before `stamp_ns`.
std::int64_t stamp_before(std::int64_t stamp_ns, double age_s, Intake& intake) {
  const double age_ns = intake.number(age_s) * kNanosecondsPerSecond;
  std::int64_t before_ns = 0;
  // The conversion to an integer is defined for finite ages within a century. The stamp may have any value.
  const bool defined = std::abs(age_ns) <= 3.2e18;
  if (!defined || __builtin_sub_overflow(stamp_ns, std::llround(age_ns), &before_ns))
    intake.refuse("not_finite");
  return before_ns;
}

}  // namespace

Point Intake::point(const msg::Point& from) { return {number(from.x()), number(from.y()), number(from.z())}; }

Polyline Intake::polyline(const std::vector<msg::Point>& from) {
  return convert_all<Point>(from, [this](const msg::Point& p) { return point(p); });
}

Eigen::Quaterniond Intake::rotation(const msg::Quaternion& from) {
  const Eigen::Quaterniond q(number(from.w()), number(from.x()), number(from.y()), number(from.z()));
  if (!is_unit(q)) {
    refuse("not_a_rotation");
    return Eigen::Quaterniond::Identity();
  }
  return q.normalized();
}

msg::Point to_msg(const Point& from) {
  msg::Point to;
  to.x(from.x());
  to.y(from.y());
  to.z(from.z());
  return to;
}

std::vector<msg::Point> to_msg(const Polyline& from) {
  return convert_all<msg::Point>(from, [](const Point& p) { return to_msg(p); });
}

msg::Range to_msg(const laneloom::Stretch& from) {
  msg::Range to;
  to.from_m(from.from_m);
  to.to_m(from.to_m);
  return to;
}

msg::Pose pose_to_msg(const Point& position, const Eigen::Quaterniond& orientation) {
  msg::Pose to;
  to.position(to_msg(position));
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
  to.frame_id(frame_id.c_str());
  return to;
}

msg::Marking to_msg(const Marking& from, std::int64_t stamp_ns) {
  msg::Marking to;
  to.id(from.id);
  to.type(enum_to_msg<msg::MarkingType>(from.type));
  to.status(enum_to_msg<msg::ElementStatus>(from.status));
  to.points(to_msg(from.points));
  to.styles(convert_all<msg::StyleRange>(from.styles, [](const StyleRange& style) {
    msg::StyleRange result;
    result.range(to_msg(style.range));
    result.style(enum_to_msg<msg::MarkingStyle>(style.style));
    return result;
  }));
  to.lateral_stddev_m(from.lateral_stddev_m);
  to.existence_probability(from.existence_probability);
  to.observations(from.observations);
  to.age_s(static_cast<double>(stamp_ns - from.first_seen_ns) / kNanosecondsPerSecond);
  const auto unseen_ns = static_cast<double>(stamp_ns - from.last_seen_ns);
  to.unseen_s(from.last_seen_ns == 0 ? -1.0 : unseen_ns / kNanosecondsPerSecond);
  return to;
}

Marking from_msg(const msg::Marking& from, std::int64_t stamp_ns, Intake& intake) {
  Marking to;
  to.id = from.id();
  to.type = intake.enumeration(from.type(), MarkingType::stopline);
  to.status = intake.enumeration(from.status(), ElementStatus::inferred);
  to.points = intake.polyline(from.points());
  to.styles = convert_all<StyleRange>(from.styles(), [&](const msg::StyleRange& style) {
    return StyleRange{intake.range(style.range()), intake.enumeration(style.style(), MarkingStyle::dashed)};
  });
  to.lateral_stddev_m = intake.numbers(from.lateral_stddev_m());
  intake.sizes_match(to.lateral_stddev_m.size(), to.points.size());
  to.existence_probability = intake.number(from.existence_probability());
  to.observations = from.observations();
  to.first_seen_ns = stamp_before(stamp_ns, from.age_s(), intake);
  if (intake.number(from.unseen_s()) >= 0.0)
    to.last_seen_ns = stamp_before(stamp_ns, from.unseen_s(), intake);
  return to;
}

}  // namespace laneloom::dds
