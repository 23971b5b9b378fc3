#include <concepts>
#include <type_traits>

#include "base/fields.hpp"
#include "cdr/bounds.hpp"
#include "cdr/convert.hpp"
#include "cdr/convert_parts.hpp"

namespace laneloom::dds {
namespace {

using dds::from_msg;  // beside the overloads here
using dds::to_msg;

/// Writes values into a message, field by field.
struct ToMessage {
  template <class Number>
  requires std::is_arithmetic_v<Number>
  static void put(Number from, Number& to) { to = from; }
  template <class Enum, class MsgEnum>
  requires std::is_enum_v<Enum>
  static void put(Enum from, MsgEnum& to) { to = enum_to_msg<MsgEnum>(from); }
  static void put(const laneloom::Stretch& from, msg::Range& to) { to = to_msg(from); }
  static void put(const Polyline& from, std::vector<msg::Point>& to) { to = to_msg(from); }
  template <class From, class To>
  static void put(const std::vector<From>& from, std::vector<To>& to) {
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) put(from[i], to[i]);
  }
  template <HasFields From, class To>
  static void put(const From& from, To& to) {
    for_each_field<From>([&](const auto& field) { put(from.*field.member, field.of_message(to)); });
  }
};

/// Takes values out of a message, field by field.
struct FromMessage {
  Intake& intake;

  void take(double from, double& to) const { to = intake.number(from); }
  template <std::unsigned_integral Number>
  void take(Number from, Number& to) const {
    to = from;
  }
  template <class MsgEnum, class Enum>
  requires std::is_enum_v<Enum>
  void take(MsgEnum from, Enum& to) const { to = intake.enumeration(from, kLast<Enum>); }
  void take(const msg::Range& from, laneloom::Stretch& to) const { to = intake.range(from); }
  void take(const std::vector<msg::Point>& from, Polyline& to) const { to = intake.polyline(from); }
  template <class From, class To>
  void take(const std::vector<From>& from, std::vector<To>& to) const {
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) take(from[i], to[i]);
  }
  template <class From, HasFields To>
  void take(const From& from, To& to) const {
    for_each_field<To>([&](const auto& field) { take(field.of_message(from), to.*field.member); });
  }
};

msg::Stopline to_msg(const Stopline& from, std::int64_t stamp_ns) {
  msg::Stopline to;
  to.marking(to_msg(from.marking, stamp_ns));
  to.lanes(from.lanes);
  to.heading(to_msg(from.heading));
  return to;
}

Stopline from_msg(const msg::Stopline& from, std::int64_t stamp_ns, Intake& intake) {
  return {from_msg(from.marking(), stamp_ns, intake), from.lanes(), intake.point(from.heading())};
}

msg::LineageEvent to_msg(const LineageEvent& from) {
  msg::LineageEvent to;
  to.kind(enum_to_msg<msg::LineageKind>(from.kind));
  to.id(from.id);
  to.other(from.other);
  return to;
}

msg::FusedFrame to_msg(const FusedFrame& from) {
  msg::FusedFrame to;
  to.source(from.source.c_str());
  to.session_id(from.session_id);
  to.sequence_number(from.sequence);
  to.stamp_ns(from.stamp_ns);
  return to;
}

void elements_to_msg(const LocalMap& from, msg::LaneMap& to) {
  const auto marking = [&](const Marking& m) { return to_msg(m, from.stamp_ns); };
  const auto stopline = [&](const Stopline& s) { return to_msg(s, from.stamp_ns); };
  to.boundaries(convert_all<msg::Marking>(from.boundaries, marking));
  ToMessage::put(from.lanes, to.lanes());
  to.stoplines(convert_all<msg::Stopline>(from.stoplines, stopline));
  ToMessage::put(from.linkages, to.linkages());
  to.lineage(convert_all<msg::LineageEvent>(from.lineage, [](const LineageEvent& e) { return to_msg(e); }));
}

void elements_from_msg(const msg::LaneMap& from, Intake& intake, LocalMap& to) {
  const auto stamp_ns = to.stamp_ns;
  to.boundaries = convert_all<Marking>(
      from.boundaries(), [&](const msg::Marking& marking) { return from_msg(marking, stamp_ns, intake); });
  FromMessage{intake}.take(from.lanes(), to.lanes);
  to.stoplines = convert_all<Stopline>(
      from.stoplines(), [&](const msg::Stopline& stopline) { return from_msg(stopline, stamp_ns, intake); });
  FromMessage{intake}.take(from.linkages(), to.linkages);
  to.lineage = convert_all<LineageEvent>(from.lineage(), [&](const msg::LineageEvent& event) {
    return LineageEvent{intake.enumeration(event.kind(), LineageEvent::Kind::retired), event.id(),
                        event.other()};
  });
}

}  // namespace

std::size_t to_msg(const PublishedMap& from, const std::string& map_frame_id, msg::LaneMap& to) {
  if (!within_bounds(from)) {
    auto bounded = from;
    const auto left_out = keep_within_bounds(bounded);
    to_msg(bounded, map_frame_id, to);
    return left_out;
  }
  to.header(header_to_msg(from.map.stamp_ns, from.sequence, from.session_id, from.frame_id));
  to.published_ns(from.published_ns);
  to.map_id(from.map_id);
  to.age_s(from.age_s);
  to.lag_s(from.lag_s);
  to.state(enum_to_msg<msg::MapState>(from.state));
  to.reasons(convert_all<msg::StateReason>(
      from.reasons, [](StateReason reason) { return enum_to_msg<msg::StateReason>(reason); }));
  to.pose(pose_to_msg(from.map.T_map_body.translation(), Eigen::Quaterniond(from.map.T_map_body.linear())));
  to.fused_frames(
      convert_all<msg::FusedFrame>(from.fused_frames, [](const FusedFrame& frame) { return to_msg(frame); }));
  elements_to_msg(from.map, to);
  return 0;
}

Refusal from_msg(const msg::LaneMap& from, const std::string& /*map_frame_id*/, PublishedMap& to) {
  Intake intake;
  to.map.stamp_ns = from.header().stamp_ns();
  to.sequence = from.header().sequence_number();
  to.session_id = from.header().session_id();
  to.frame_id = from.header().frame_id().to_string();
  to.published_ns = from.published_ns();
  to.map_id = from.map_id();
  to.age_s = intake.number(from.age_s());
  to.lag_s = intake.number(from.lag_s());
  to.state = intake.enumeration(from.state(), MapState::stale);
  to.reasons = convert_all<StateReason>(from.reasons(), [&](msg::StateReason reason) {
    return intake.enumeration(reason, StateReason::source_not_fused);
  });
  to.map.T_map_body =
      Eigen::Translation3d(intake.point(from.pose().position())) * intake.rotation(from.pose().orientation());
  to.fused_frames = convert_all<FusedFrame>(from.fused_frames(), [](const msg::FusedFrame& frame) {
    return FusedFrame{frame.source().to_string(), frame.session_id(), frame.sequence_number(),
                      frame.stamp_ns()};
  });
  elements_from_msg(from, intake, to.map);
  return intake.refusal();
}

std::size_t to_msg(const RoadMarkings& from, const std::string& map_frame_id, msg::RoadMarkings& to) {
  if (!within_bounds(from)) {
    auto bounded = from;
    const auto left_out = keep_within_bounds(bounded);
    to_msg(bounded, map_frame_id, to);
    return left_out;
  }
  to.header(header_to_msg(from.stamp_ns, from.sequence, from.session_id, from.frame_id));
  to.markings(convert_all<msg::Marking>(
      from.markings, [&](const Marking& marking) { return to_msg(marking, from.stamp_ns); }));
  return 0;
}

Refusal from_msg(const msg::RoadMarkings& from, const std::string& /*map_frame_id*/, RoadMarkings& to) {
  Intake intake;
  to.stamp_ns = from.header().stamp_ns();
  to.sequence = from.header().sequence_number();
  to.session_id = from.header().session_id();
  to.frame_id = from.header().frame_id().to_string();
  to.markings = convert_all<Marking>(
      from.markings(), [&](const msg::Marking& marking) { return from_msg(marking, to.stamp_ns, intake); });
  return intake.refusal();
}

}  // namespace laneloom::dds
