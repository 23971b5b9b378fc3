#include "message_json.hpp"

#include <string>
#include <vector>

#include "base/fields.hpp"

namespace laneloom {

using nlohmann::json;

// In their namespace, so that lists find what converts their elements.
namespace msg {

static json of(std::uint64_t value) { return std::to_string(value); }
static json of(std::int64_t value) { return std::to_string(value); }
static json of(std::uint32_t value) { return value; }
static json of(bool value) { return value; }
static json of(double value) { return value; }
template <class Enum>
requires std::is_enum_v<Enum> json of(Enum value) { return static_cast<std::uint32_t>(value); }

static json of(const Point& m) { return {{"x", m.x()}, {"y", m.y()}, {"z", m.z()}}; }
template <class Text>
requires requires(const Text& text) { text.to_string(); }
static json of(const Text& text) { return text.to_string(); }

template <class T>
static json of(const std::vector<T>& list) {
  json array = json::array();
  for (const auto& element : list) array.push_back(of(element));
  return array;
}

/// The members by the names of the table. The decoders of others compare these with the IDL's.
template <class Plain>
static json of_fields(const auto& m) {
  json object;
  for_each_field<Plain>([&](const auto& field) { object[field.name] = of(field.of_message(m)); });
  return object;
}
static json of(const Range& m) { return of_fields<laneloom::Stretch>(m); }
static json of(const Detection& m) { return of_fields<laneloom::Detection>(m); }
static json of(const TrackedObject& m) { return of_fields<laneloom::TrackedObject>(m); }
static json of(const StyleRange& m) { return of_fields<laneloom::StyleRange>(m); }
static json of(const Marking& m) { return of_fields<laneloom::Marking>(m); }
static json of(const LineageEvent& m) { return of_fields<laneloom::LineageEvent>(m); }
static json of(const Neighbour& m) { return of_fields<laneloom::Neighbour>(m); }
static json of(const Border& m) { return of_fields<laneloom::Border>(m); }
static json of(const Lane& m) { return of_fields<laneloom::Lane>(m); }
static json of(const Stopline& m) { return of_fields<laneloom::Stopline>(m); }
static json of(const Linkage& m) { return of_fields<laneloom::Linkage>(m); }
static json of(const WayStation& m) { return of_fields<laneloom::WayStation>(m); }
static json of(const WayLane& m) { return of_fields<laneloom::WayLane>(m); }
static json of(const Way& m) { return of_fields<laneloom::Way>(m); }
static json of(const DrivenPath& m) { return of_fields<laneloom::DrivenPath>(m); }
static json of(const FusedFrame& m) { return of_fields<laneloom::FusedFrame>(m); }

static json of(const Header& m) {
  return {{"crc", of(m.crc())},
          {"data_id", m.data_id()},
          {"stamp_ns", of(m.stamp_ns())},
          {"sequence_number", of(m.sequence_number())},
          {"session_id", of(m.session_id())},
          {"frame_id", m.frame_id().to_string()}};
}

static json of(const Pose& m) {
  const auto& q = m.orientation();
  return {{"position", of(m.position())},
          {"orientation", {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}}}};
}

static json of(const Area& m) { return {{"outline", of(m.outline())}}; }

static json of(const TimeSummary& m) {
  return {{"mean_ms", m.mean_ms()}, {"p50_ms", m.p50_ms()}, {"p99_ms", m.p99_ms()}, {"max_ms", m.max_ms()}};
}

static json of(const NamedValue& m) { return {{"name", m.name().to_string()}, {"value", m.value()}}; }

static json of(const Setting& m) { return {{"key", m.key().to_string()}, {"value", m.value().to_string()}}; }

static json of(const SourceStatus& m) {
  return {{"source", m.source().to_string()},
          {"session_id", of(m.session_id())},
          {"first_sequence", of(m.first_sequence())},
          {"last_sequence", of(m.last_sequence())},
          {"frames", of(m.frames())},
          {"fused", of(m.fused())},
          {"lag_s", m.lag_s()},
          {"learned", of(m.learned())}};
}

static json of(const Counter& m) { return {{"name", m.name().to_string()}, {"value", of(m.value())}}; }

}  // namespace msg

using msg::of;

json json_of(const msg::Detections& m) {
  return {{"header", of(m.header())},
          {"source", m.source().to_string()},
          {"detected_types", of(m.detected_types())},
          {"field_of_view", of(m.field_of_view())},
          {"occluded_areas", of(m.occluded_areas())},
          {"detections", of(m.detections())}};
}

json json_of(const msg::VehiclePose& m) {
  return {{"header", of(m.header())}, {"pose", of(m.pose())}, {"covariance", of(m.covariance())}};
}

json json_of(const msg::NextTurn& m) {
  return {{"header", of(m.header())}, {"turn", of(m.turn())}, {"distance_m", m.distance_m()}};
}
json json_of(const msg::Objects& m) { return {{"header", of(m.header())}, {"objects", of(m.objects())}}; }

json json_of(const msg::LaneMap& m) {
  return {{"header", of(m.header())},
          {"published_ns", of(m.published_ns())},
          {"map_id", of(m.map_id())},
          {"age_s", m.age_s()},
          {"lag_s", m.lag_s()},
          {"state", of(m.state())},
          {"reasons", of(m.reasons())},
          {"pose", of(m.pose())},
          {"fused_frames", of(m.fused_frames())},
          {"boundaries", of(m.boundaries())},
          {"lanes", of(m.lanes())},
          {"stoplines", of(m.stoplines())},
          {"linkages", of(m.linkages())},
          {"way", of(m.way())},
          {"driven_paths", of(m.driven_paths())},
          {"lineage", of(m.lineage())}};
}

json json_of(const msg::RoadMarkings& m) {
  return {{"header", of(m.header())}, {"markings", of(m.markings())}};
}

json json_of(const msg::ServiceStatus& m) {
  return {{"header", of(m.header())},
          {"state", of(m.state())},
          {"reasons", of(m.reasons())},
          {"uptime_s", m.uptime_s()},
          {"detections_age_s", m.detections_age_s()},
          {"poses_age_s", m.poses_age_s()},
          {"tick", of(m.tick())},
          {"tick_delay", of(m.tick_delay())},
          {"pending_frames", m.pending_frames()},
          {"counters", of(m.counters())},
          {"sources", of(m.sources())},
          {"version", m.version().to_string()},
          {"config_hash", m.config_hash().to_string()},
          {"configuration", of(m.configuration())}};
}

}  // namespace laneloom
