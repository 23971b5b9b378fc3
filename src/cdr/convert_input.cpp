#include <algorithm>
#include <type_traits>

#include "cdr/convert.hpp"
#include "cdr/convert_parts.hpp"

namespace laneloom::dds {
namespace {

using dds::to_msg;  // beside the overload here

constexpr const char* kBodyFrame = "body";

constexpr std::size_t kMaxName = std::remove_cvref_t<decltype(msg::Detections().source())>::max_size;

/// Types that fit into a message. A list that is too long is reduced to one of each type. It must not become
/// empty, which would mean every type.
std::vector<MarkingType> fitting(std::vector<MarkingType> types) {
  static_assert(kMarkingTypeCount <= msg::MAX_TYPES);
  if (types.size() <= msg::MAX_TYPES) return types;
  std::ranges::sort(types);
  types.erase(std::unique(types.begin(), types.end()), types.end());
  return types;
}

bool is_in_bounds(const Polyline& line) { return line.size() <= msg::MAX_POINTS; }

msg::Area area_to_msg(const Polyline& from) {
  msg::Area to;
  to.outline(to_msg(from));
  return to;
}

msg::Detection to_msg(const Detection& from) {
  msg::Detection to;
  to.type(enum_to_msg<msg::MarkingType>(from.type));
  to.style(enum_to_msg<msg::MarkingStyle>(from.style));
  to.confidence(from.confidence);
  to.points(to_msg(from.points));
  to.stddev_m(from.stddev_m);
  return to;
}

Detection from_msg(const msg::Detection& from, Intake& intake) {
  Detection to;
  to.type = intake.enumeration(from.type(), MarkingType::stopline);
  to.style = intake.enumeration(from.style(), MarkingStyle::dashed);
  to.confidence = intake.number(from.confidence());
  to.points = intake.polyline(from.points());
  to.stddev_m = intake.numbers(from.stddev_m());
  intake.sizes_match(to.stddev_m.size(), to.points.size());
  return to;
}

}  // namespace

std::size_t to_msg(const DetectionFrame& from, const std::string& /*map_frame_id*/, msg::Detections& to) {
  std::size_t left_out = 0;
  to.header(header_to_msg(from.stamp_ns, from.sequence, from.session_id, kBodyFrame));
  to.source(from.source.c_str());  // cut to its bound; readers may then take two sources for one
  left_out += from.source.size() <= kMaxName ? 0U : 1U;
  to.detected_types(convert_all<msg::MarkingType>(
      fitting(from.detected_types), [](MarkingType type) { return enum_to_msg<msg::MarkingType>(type); }));
  to.field_of_view(is_in_bounds(from.field_of_view) ? to_msg(from.field_of_view) : std::vector<msg::Point>{});
  left_out += is_in_bounds(from.field_of_view) ? 0U : 1U;

  to.occluded_areas().clear();
  for (const auto& area : from.occluded_areas) {
    const bool taken = is_in_bounds(area) && to.occluded_areas().size() < msg::MAX_AREAS;
    if (taken) to.occluded_areas().push_back(area_to_msg(area));
    left_out += taken ? 0U : 1U;
  }
  to.detections().clear();
  for (const auto& detection : from.detections) {
    const bool taken = is_in_bounds(detection.points) && detection.stddev_m.size() <= msg::MAX_POINTS &&
                       to.detections().size() < msg::MAX_MARKINGS;
    if (taken) to.detections().push_back(to_msg(detection));
    left_out += taken ? 0U : 1U;
  }
  return left_out;
}

Refusal from_msg(msg::Detections&& from, const std::string& map_frame_id, DetectionFrame& to) {
  Intake intake;
  // The body frame may have any other name. Coordinates in the map frame would be taken for ones about the
  // vehicle.
  if (intake.text(from.header().frame_id().to_string()) == map_frame_id) intake.refuse("wrong_frame");
  to.stamp_ns = from.header().stamp_ns();
  to.sequence = from.header().sequence_number();
  to.session_id = from.header().session_id();
  to.source = intake.text(from.source().to_string());
  to.detected_types = convert_all<MarkingType>(from.detected_types(), [&](msg::MarkingType type) {
    return intake.enumeration(type, MarkingType::stopline);
  });
  to.field_of_view = intake.polyline(from.field_of_view());
  to.occluded_areas = convert_all<Polyline>(
      from.occluded_areas(), [&](const msg::Area& area) { return intake.polyline(area.outline()); });
  to.detections.clear();
  to.detections.reserve(from.detections().size());
  for (msg::Detection& detection : from.detections()) {
    to.detections.push_back(from_msg(detection, intake));
    detection = msg::Detection();
  }
  return intake.refusal();
}

std::size_t to_msg(const VehiclePose& from, const std::string& map_frame_id, msg::VehiclePose& to) {
  to.header(header_to_msg(from.stamp_ns, from.sequence, from.session_id, map_frame_id));
  to.pose(pose_to_msg(from.position, from.orientation));
  to.covariance().clear();
  return 0;
}

Refusal from_msg(const msg::VehiclePose& from, const std::string& map_frame_id, VehiclePose& to) {
  Intake intake;
  to.stamp_ns = from.header().stamp_ns();
  to.sequence = from.header().sequence_number();
  to.session_id = from.header().session_id();
  // A pose in another frame would give a map that names a wrong frame.
  if (from.header().frame_id().to_string() != map_frame_id) intake.refuse("wrong_frame");
  to.position = intake.point(from.pose().position());
  to.orientation = intake.rotation(from.pose().orientation());
  intake.sizes_match(from.covariance().size(), 36);
  intake.numbers(from.covariance());
  return intake.refusal();
}

}  // namespace laneloom::dds
