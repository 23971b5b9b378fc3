#include "base/is_local.hpp"
#include "cdr/bounds.hpp"
#include "cdr/convert.hpp"
#include "cdr/convert_parts.hpp"

namespace laneloom::dds {
namespace {

/// Leaves out what is beyond the bounds of the IDL. Returns how many elements that was.
template <class T, class Message>
std::size_t bounded_to_msg(T from, const std::string& map_frame_id, Message& to) {
  const auto left_out = keep_within_bounds(from);
  to_msg(from, map_frame_id, to);
  return left_out;
}

/// A way without stations is sent where there is none.
std::optional<Way> way_of(const msg::Way& from, Intake& intake) {
  if (from.stations().empty()) return std::nullopt;
  Way way;
  intake.take(from, way);
  if (!way.is_line()) intake.refuse("wrong_size");
  return way;
}

}  // namespace

std::size_t to_msg(const PublishedMap& from, const std::string& map_frame_id, msg::LaneMap& to) {
  if (!within_bounds(from)) return bounded_to_msg(from, map_frame_id, to);
  to.header(header_to_msg(from.map.stamp_ns, from.sequence, from.session_id, from.frame_id));
  to.published_ns(from.published_ns);
  to.map_id(from.map_id);
  to.age_s(from.age_s);
  to.lag_s(from.lag_s);
  const ToMessage out{from.map.stamp_ns};
  out.put(from.state, to.state());
  out.put(from.reasons, to.reasons());
  to.pose(pose_to_msg(from.map.T_map_body.translation(), Eigen::Quaterniond(from.map.T_map_body.linear())));
  out.put(from.fused_frames, to.fused_frames());
  out.put(from.map.boundaries, to.boundaries());
  out.put(from.map.lanes, to.lanes());
  out.put(from.map.stoplines, to.stoplines());
  out.put(from.map.linkages, to.linkages());
  out.put(from.map.way.value_or(Way()), to.way());
  out.put(from.map.driven_paths, to.driven_paths());
  out.put(from.map.lineage, to.lineage());
  return 0;
}

Refusal from_msg(const msg::LaneMap& from, const std::string& /*map_frame_id*/, PublishedMap& to) {
  to.map.stamp_ns = from.header().stamp_ns();
  Intake intake(to.map.stamp_ns);
  to.sequence = from.header().sequence_number();
  to.session_id = from.header().session_id();
  to.frame_id = from.header().frame_id().to_string();
  to.published_ns = from.published_ns();
  to.map_id = from.map_id();
  intake.take(from.age_s(), to.age_s);
  intake.take(from.lag_s(), to.lag_s);
  intake.take(from.state(), to.state);
  intake.take(from.reasons(), to.reasons);
  to.map.T_map_body =
      Eigen::Translation3d(intake.point(from.pose().position())) * intake.rotation(from.pose().orientation());
  intake.take(from.fused_frames(), to.fused_frames);
  intake.take(from.boundaries(), to.map.boundaries);
  intake.take(from.lanes(), to.map.lanes);
  intake.take(from.stoplines(), to.map.stoplines);
  intake.take(from.linkages(), to.map.linkages);
  to.map.way = way_of(from.way(), intake);
  intake.take(from.driven_paths(), to.map.driven_paths);
  intake.take(from.lineage(), to.map.lineage);
  if (!is_local(to.map)) intake.refuse("coordinate");
  return intake.refusal();
}

std::size_t to_msg(const RoadMarkings& from, const std::string& map_frame_id, msg::RoadMarkings& to) {
  if (!within_bounds(from)) return bounded_to_msg(from, map_frame_id, to);
  to.header(header_to_msg(from.stamp_ns, from.sequence, from.session_id, from.frame_id));
  ToMessage{from.stamp_ns}.put(from.markings, to.markings());
  return 0;
}

Refusal from_msg(const msg::RoadMarkings& from, const std::string& /*map_frame_id*/, RoadMarkings& to) {
  to.stamp_ns = from.header().stamp_ns();
  Intake intake(to.stamp_ns);
  to.sequence = from.header().sequence_number();
  to.session_id = from.header().session_id();
  to.frame_id = from.header().frame_id().to_string();
  intake.take(from.markings(), to.markings);
  return intake.refusal();
}

}  // namespace laneloom::dds
