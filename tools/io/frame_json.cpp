#include <cmath>
#include <utility>

#include "base/seconds.hpp"
#include "io/element_json.hpp"
#include "io/json_lines.hpp"
#include "io/stamp_and_pose.hpp"

namespace laneloom::io {
namespace {

using nlohmann::json;

constexpr double kMaxTime_s = 4.6e9;  // in round numbers, that of kMaxStamp_ns

json to_json(const Detection& detection) {
  json out = ToJson::of(detection);
  if (detection.stddev_m.empty()) out.erase("stddev");
  return out;
}

/// A detection whose confidence is not checked, because it may be on another scale.
Detection with_any_confidence(json value) {
  const double confidence = required(value, "score", number);
  value["score"] = 0.0;
  auto out = FromJson::element<Detection>(value);
  out.confidence = confidence;
  return out;
}

Detection detection(const json& value, bool any_confidence) {
  Detection out = any_confidence ? with_any_confidence(value) : FromJson::element<Detection>(value);
  if (out.points.size() < 2) throw JsonError("points", "must have at least two points");
  if (!out.stddev_m.empty() && out.stddev_m.size() != out.points.size())
    throw JsonError("stddev", "must have one value per point");
  return out;
}

/// Makes a class's name that of its type. False: lines of that class are left out.
bool take_class(json& name_of_class, const Classes& classes) {
  const auto found =
      name_of_class.is_string() ? classes.find(name_of_class.get<std::string>()) : classes.end();
  if (found == classes.end()) return true;
  if (found->second) name_of_class = name(*found->second);
  return found->second.has_value();
}

/// The same of a detection.
bool take_class_of(json& detection, const Classes& classes) {
  return classes.empty() || !detection.is_object() || !detection.contains("type") ||
         take_class(detection["type"], classes);
}

/// The detections that can be read. Throws JsonError if there are some, and none can be.
std::vector<Detection> detections(json items, const FrameReading& reading) {
  std::vector<Detection> out;
  std::size_t unused = 0;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (take_class_of(items[i], reading.conventions.classes))
      take_or_leave_out(reading.left_out, reading.place + ".", "detections[" + std::to_string(i) + "]",
                        [&] { out.push_back(detection(items[i], reading.conventions.any_confidence)); });
    else
      ++unused;
  if (out.empty() && unused < items.size()) throw JsonError("detections", "none of them can be read");
  return out;
}

/// The objects that can be read.
std::vector<TrackedObject> tracked_objects(const json& items, const FrameReading& reading) {
  std::vector<TrackedObject> out;
  const std::size_t size = array(items)->size();
  for (std::size_t i = 0; i < size; ++i)
    take_or_leave_out(reading.left_out, reading.place + ".", "objects[" + std::to_string(i) + "]",
                      [&] { out.push_back(FromJson::element<TrackedObject>(items[i])); });
  return out;
}

/// The next turn of the route, at the stamp of a frame; none: nothing is told.
std::optional<NextTurn> next_turn(const json& object, const DetectionFrame& frame) {
  std::optional<NextTurn> turn = optional(object, "next_turn", FromJson::element<NextTurn>);
  if (!turn) return turn;
  if (turn->distance_m < 0.0) throw JsonError("next_turn", "must not be negative");
  return NextTurn{frame.stamp_ns, frame.sequence, frame.session_id, turn->turn, turn->distance_m};
}

/// The types that the network can detect.
std::vector<MarkingType> detected_types(const json& items, const Classes& classes) {
  std::vector<MarkingType> types;
  list(items, [&](json name_of_class) {
    if (take_class(name_of_class, classes)) types.push_back(marking_type(name_of_class));
    return true;
  });
  return types;
}

}  // namespace

void put_stamp_and_pose(json& object, std::int64_t stamp_ns, const Point& position,
                        const Eigen::Quaterniond& orientation) {
  object["t"] = static_cast<double>(stamp_ns) * 1e-9;
  object["stamp_ns"] = stamp_ns;
  object["pose"] = {position.x(),    position.y(),    position.z(),   orientation.x(),
                    orientation.y(), orientation.z(), orientation.w()};
}

std::int64_t read_stamp_ns(const json& object) {
  const double t_s = required(object, "t", number);
  if (!(std::abs(t_s) < kMaxTime_s)) throw JsonError("t", "is too large");
  const std::int64_t stamp_ns =
      optional(object, "stamp_ns", integer).value_or(static_cast<std::int64_t>(std::llround(t_s * 1e9)));
  if (stamp_ns >= kMaxStamp_ns) throw JsonError("stamp_ns", "is too large");
  return stamp_ns;
}

VehiclePose read_pose(const json& object) {
  return required(object, "pose", [](const json& value) {
    if (!value.is_array() || value.size() != 7) throw JsonError("must be [x, y, z, qx, qy, qz, qw]");
    VehiclePose pose;
    pose.position = {coordinate(value[0]), coordinate(value[1]), coordinate(value[2])};
    pose.orientation = quaternion(value, 3);
    return pose;
  });
}

std::string to_json_line(const FrameRecord& record) {
  const DetectionFrame& frame = record.frame;
  json out{{"sequence", frame.sequence}, {"session_id", frame.session_id}, {"detections", json::array()}};
  put_stamp_and_pose(out, frame.stamp_ns, record.pose.position, record.pose.orientation);
  for (const Detection& detection : frame.detections) out["detections"].push_back(to_json(detection));
  if (!frame.source.empty()) out["source"] = frame.source;
  for (const MarkingType type : frame.detected_types) out["detected_types"].push_back(name(type));
  if (!frame.field_of_view.empty()) out["field_of_view"] = polyline_json(frame.field_of_view);
  for (const Polyline& area : frame.occluded_areas) out["occluded_areas"].push_back(polyline_json(area));
  if (record.objects)
    out["objects"] = ToJson::of(in_body_frame(*record.objects, transform(record.pose)).objects);
  if (record.next_turn) out["next_turn"] = ToJson::of(*record.next_turn);
  return out.dump();
}

FrameRecord frame_from_json(std::string_view text) {
  LeftOut nothing(/*strict=*/true);
  return frame_from_json(text, {.left_out = nothing});
}

FrameRecord frame_from_json(std::string_view text, const FrameReading& reading) {
  json object = parse_json(text);
  FrameRecord record;
  DetectionFrame& frame = record.frame;
  frame.stamp_ns = read_stamp_ns(object);
  if (frame.stamp_ns < 0 || required(object, "t", number) < 0.0) throw JsonError("t", "must be 0 or above");
  if (frame.stamp_ns == 0) frame.stamp_ns = 1;  // a stamp of 0 would say that there is none
  record.pose = read_pose(object);
  required(object, "detections", array);
  frame.detections = detections(std::move(object["detections"]), reading);
  frame.sequence = optional(object, "sequence", count).value_or(0);
  frame.session_id = optional(object, "session_id", count).value_or(0);
  frame.source = optional(object, "source", io::text).value_or("");
  frame.field_of_view = optional(object, "field_of_view", polyline).value_or(Polyline{});
  const auto types = [&](const json& items) { return detected_types(items, reading.conventions.classes); };
  frame.detected_types = optional(object, "detected_types", types).value_or(std::vector<MarkingType>{});
  const auto areas = [](const json& items) { return list(items, polyline); };
  frame.occluded_areas = optional(object, "occluded_areas", areas).value_or(std::vector<Polyline>{});
  record.pose.stamp_ns = frame.stamp_ns;
  const auto can_be_read = [&](const json& items) { return tracked_objects(items, reading); };
  if (auto objects = optional(object, "objects", can_be_read))
    record.objects = TrackedObjects{frame.stamp_ns, frame.sequence, frame.session_id, *std::move(objects)};
  take_or_leave_out(reading.left_out, reading.place + ".", "next_turn",
                    [&] { record.next_turn = next_turn(object, frame); });
  return record;
}

}  // namespace laneloom::io
