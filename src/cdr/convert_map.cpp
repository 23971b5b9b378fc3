#include "cdr/bounds.hpp"
#include "cdr/convert.hpp"
#include "cdr/convert_parts.hpp"

namespace laneloom::dds {
namespace {

using dds::from_msg;  // beside the overloads here
using dds::to_msg;

std::vector<msg::Range> to_msg(const std::vector<laneloom::Stretch>& from) {
  return convert_all<msg::Range>(from, [](const laneloom::Stretch& range) { return to_msg(range); });
}

std::vector<laneloom::Stretch> from_msg(const std::vector<msg::Range>& from, Intake& intake) {
  return convert_all<laneloom::Stretch>(from, [&](const msg::Range& range) { return intake.range(range); });
}

std::vector<msg::Neighbour> to_msg(const std::vector<Neighbour>& from) {
  return convert_all<msg::Neighbour>(from, [](const Neighbour& neighbour) {
    msg::Neighbour to;
    to.lane(neighbour.lane);
    to.range(to_msg(neighbour.range));
    to.crossable(to_msg(neighbour.crossable));
    return to;
  });
}

std::vector<Neighbour> from_msg(const std::vector<msg::Neighbour>& from, Intake& intake) {
  return convert_all<Neighbour>(from, [&](const msg::Neighbour& neighbour) {
    return Neighbour{neighbour.lane(), intake.range(neighbour.range()),
                     from_msg(neighbour.crossable(), intake)};
  });
}

msg::Lane to_msg(const Lane& from) {
  msg::Lane to;
  to.id(from.id);
  to.left_boundary(from.left_boundary);
  to.right_boundary(from.right_boundary);
  to.left_range(to_msg(from.left_range));
  to.right_range(to_msg(from.right_range));
  to.left(to_msg(from.left));
  to.right(to_msg(from.right));
  to.centerline(to_msg(from.centerline));
  to.width_m(from.width_m);
  to.left_neighbours(to_msg(from.left_neighbours));
  to.right_neighbours(to_msg(from.right_neighbours));
  to.direction(enum_to_msg<msg::DrivingDirection>(from.direction));
  to.section(from.section);
  to.status(enum_to_msg<msg::ElementStatus>(from.status));
  to.existence_probability(from.existence_probability);
  to.inferred_ranges(to_msg(from.inferred_ranges));
  return to;
}

Lane from_msg(const msg::Lane& from, Intake& intake) {
  Lane to;
  to.id = from.id();
  to.left_boundary = from.left_boundary();
  to.right_boundary = from.right_boundary();
  to.left_range = intake.range(from.left_range());
  to.right_range = intake.range(from.right_range());
  to.left = intake.polyline(from.left());
  to.right = intake.polyline(from.right());
  to.centerline = intake.polyline(from.centerline());
  to.width_m = intake.number(from.width_m());
  to.left_neighbours = from_msg(from.left_neighbours(), intake);
  to.right_neighbours = from_msg(from.right_neighbours(), intake);
  to.direction = intake.enumeration(from.direction(), Lane::Direction::against_centerline);
  to.section = from.section();
  to.status = intake.enumeration(from.status(), ElementStatus::inferred);
  to.existence_probability = intake.number(from.existence_probability());
  to.inferred_ranges = from_msg(from.inferred_ranges(), intake);
  return to;
}

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

msg::Linkage to_msg(const Linkage& from) {
  msg::Linkage to;
  to.from_lane(from.from);
  to.to_lane(from.to);
  to.kind(enum_to_msg<msg::LinkageKind>(from.kind));
  to.turn(enum_to_msg<msg::TurnKind>(from.turn));
  to.confidence(from.confidence);
  to.path(to_msg(from.path));
  return to;
}

Linkage from_msg(const msg::Linkage& from, Intake& intake) {
  return {from.from_lane(),
          from.to_lane(),
          intake.enumeration(from.kind(), Linkage::Kind::ego_track),
          intake.enumeration(from.turn(), Linkage::Turn::u_turn),
          intake.number(from.confidence()),
          intake.polyline(from.path())};
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
  to.lanes(convert_all<msg::Lane>(from.lanes, [](const Lane& lane) { return to_msg(lane); }));
  to.stoplines(convert_all<msg::Stopline>(from.stoplines, stopline));
  to.linkages(convert_all<msg::Linkage>(from.linkages, [](const Linkage& link) { return to_msg(link); }));
  to.lineage(convert_all<msg::LineageEvent>(from.lineage, [](const LineageEvent& e) { return to_msg(e); }));
}

void elements_from_msg(const msg::LaneMap& from, Intake& intake, LocalMap& to) {
  const auto stamp_ns = to.stamp_ns;
  to.boundaries = convert_all<Marking>(
      from.boundaries(), [&](const msg::Marking& marking) { return from_msg(marking, stamp_ns, intake); });
  to.lanes = convert_all<Lane>(from.lanes(), [&](const msg::Lane& lane) { return from_msg(lane, intake); });
  to.stoplines = convert_all<Stopline>(
      from.stoplines(), [&](const msg::Stopline& stopline) { return from_msg(stopline, stamp_ns, intake); });
  to.linkages = convert_all<Linkage>(from.linkages(),
                                     [&](const msg::Linkage& linkage) { return from_msg(linkage, intake); });
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
