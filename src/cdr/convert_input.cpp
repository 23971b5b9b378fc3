#include <algorithm>

#include "base/vehicle_frame.hpp"
#include "cdr/bounds.hpp"
#include "cdr/convert.hpp"
#include "cdr/convert_parts.hpp"

namespace laneloom::dds {
namespace {

/// Types that fit into a message. A list that is too long is reduced to one of each type. It must not become
/// empty, which would mean every type.
std::vector<MarkingType> fitting(std::vector<MarkingType> types) {
  static_assert(kMarkingTypeCount <= msg::MAX_TYPES);
  if (types.size() <= msg::MAX_TYPES) return types;
  std::ranges::sort(types);
  types.erase(std::unique(types.begin(), types.end()), types.end());
  return types;
}

/// Puts elements into a message: those that fit, as many as the IDL allows. Returns how many were left out.
template <class From, class To>
std::size_t put_fitting(const std::vector<From>& from, std::vector<To>& to) {
  to.clear();
  for (const From& element : from) {
    if (to.size() < kMaxLength<From> && fits(element)) ToMessage().put(element, to.emplace_back());
  }
  return from.size() - to.size();
}

}  // namespace

std::size_t to_msg(const DetectionFrame& from, const std::string& /*map_frame_id*/, msg::Detections& to) {
  to.header(header_to_msg(from.stamp_ns, from.sequence, from.session_id, kBodyFrame));
  ToMessage().put(from.source, to.source());  // readers may take two sources for one if it is cut
  std::size_t left_out = to.source().to_string() == from.source ? 0U : 1U;
  ToMessage().put(fitting(from.detected_types), to.detected_types());
  ToMessage().put(fits(from.field_of_view) ? from.field_of_view : Polyline{}, to.field_of_view());
  left_out += fits(from.field_of_view) ? 0U : 1U;
  left_out += put_fitting(from.occluded_areas, to.occluded_areas());
  left_out += put_fitting(from.detections, to.detections());
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
  intake.take(from.detected_types(), to.detected_types);
  intake.take(from.field_of_view(), to.field_of_view);
  intake.take(from.occluded_areas(), to.occluded_areas);
  to.detections.clear();
  to.detections.reserve(from.detections().size());
  for (msg::Detection& detection : from.detections()) {
    intake.take(detection, to.detections.emplace_back());
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

std::size_t to_msg(const TrackedObjects& from, const std::string& map_frame_id, msg::Objects& to) {
  const std::string frame_id = from.in_map_frame ? map_frame_id : kBodyFrame;
  to.header(header_to_msg(from.stamp_ns, from.sequence, from.session_id, frame_id));
  return put_fitting(from.objects, to.objects());
}

Refusal from_msg(const msg::Objects& from, const std::string& map_frame_id, TrackedObjects& to) {
  Intake intake;
  to.stamp_ns = from.header().stamp_ns();
  to.sequence = from.header().sequence_number();
  to.session_id = from.header().session_id();
  const std::string frame_id = intake.text(from.header().frame_id().to_string());
  to.in_map_frame = frame_id == map_frame_id;
  // Coordinates in a third frame, such as odom, would be taken for ones about the vehicle.
  const bool in_body_frame = frame_id.empty() || frame_id == kBodyFrame || frame_id == kBaseLink;
  if (!to.in_map_frame && !in_body_frame) intake.refuse("wrong_frame");
  intake.take(from.objects(), to.objects);
  return intake.refusal();
}

std::size_t to_msg(const NextTurn& from, const std::string& /*map_frame_id*/, msg::NextTurn& to) {
  to.header(header_to_msg(from.stamp_ns, from.sequence, from.session_id, ""));
  ToMessage().put(from, to);
  return 0;
}

Refusal from_msg(const msg::NextTurn& from, const std::string& /*map_frame_id*/, NextTurn& to) {
  Intake intake;
  to.stamp_ns = from.header().stamp_ns();
  to.sequence = from.header().sequence_number();
  to.session_id = from.header().session_id();
  intake.text(from.header().frame_id().to_string());
  intake.take(from, to);
  return intake.refusal();
}

}  // namespace laneloom::dds
