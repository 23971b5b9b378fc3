#include "ros2/tracked_objects.hpp"

#include <algorithm>
#include <cmath>

#include "Common.hpp"
#include "base/fnv.hpp"
#include "base/vehicle_frame.hpp"
#include "ros2/input_parts.hpp"
#include "ros2/names.hpp"

namespace laneloom::ros2 {
namespace {

using autoware_perception_msgs::msg::dds_::ObjectClassification_;
using autoware_perception_msgs::msg::dds_::TrackedObject_;
using autoware_perception_msgs::msg::dds_::TrackedObjectKinematics_;

constexpr std::size_t kMaxClasses = 64;  // far more than there are
constexpr std::size_t kY = 7;            // of the variance of y in a covariance of 6 x 6
constexpr double kSureOfSign_mps = 1.0;  // the velocity of a vehicle that stands has any sign

/// TrackedObjectKinematics.orientation_availability, as Autoware numbers it.
enum Orientation : std::uint8_t { kUnavailable, kSignUnknown, kAvailable };

void scan_object(dds::CdrScanner& cdr) {
  cdr.numbers(sizeof(std::uint8_t), 16);
  cdr.numbers(sizeof(float));
  cdr.sequence(kMaxClasses, [](dds::CdrScanner& classification) {
    classification.numbers(sizeof(std::uint8_t));
    classification.numbers(sizeof(float));
  });
  cdr.numbers(sizeof(double), 7 + kCovariance);  // pose
  cdr.numbers(sizeof(double), 6 + kCovariance);  // twist
  cdr.numbers(sizeof(double), 6 + kCovariance);  // acceleration
  cdr.numbers(sizeof(std::uint8_t), 3);          // up to the shape's type
  cdr.sequence(msg::MAX_POINTS, [](dds::CdrScanner& point) { point.numbers(sizeof(float), 3); });
  cdr.numbers(sizeof(double), 3);
}

/// The most probable class. Autoware numbers classes as laneloom does, and has more of them.
ObjectKind kind_of(const std::vector<ObjectClassification_>& classes, dds::Intake& intake) {
  const auto likely = std::ranges::max_element(classes, {}, [&](const ObjectClassification_& each) {
    return intake.number(static_cast<double>(each.probability()));
  });
  if (likely == classes.end() || likely->label() > static_cast<std::uint8_t>(ObjectKind::pedestrian))
    return ObjectKind::unknown;
  return static_cast<ObjectKind>(likely->label());
}

/// Horizontal deviation; -1 where a variance is none.
double stddev_of(const std::array<double, kCovariance>& covariance) {
  const double variance = std::max(covariance[0], covariance[kY]);
  return covariance[0] >= 0.0 && covariance[kY] >= 0.0 && std::isfinite(variance) ? std::sqrt(variance)
                                                                                  : -1.0;
}

double length_of(double dimension) { return dimension > 0.0 ? dimension : -1.0; }

/// Sets heading and speed. Autoware's detectors are sure of the sign of the heading for no car: the axis then
/// points where the object moves, as Autoware's own prediction takes it.
void take_motion(const TrackedObjectKinematics_& kinematics, dds::Intake& intake, TrackedObject& to) {
  const std::uint8_t availability = kinematics.orientation_availability();
  if (availability > kAvailable) intake.refuse("unknown_enum");
  if (!kinematics.is_stationary())
    to.speed_mps = intake.number(kinematics.twist_with_covariance().twist().linear().x());
  const bool moves = std::abs(to.speed_mps) > kSureOfSign_mps;
  if (availability != kAvailable && !(availability == kSignUnknown && moves)) return;
  to.heading = rotation_of(kinematics.pose_with_covariance().pose().orientation(), intake) * Point::UnitX();
  if (availability == kAvailable || to.speed_mps > 0.0) return;
  to.heading = -to.heading;
  to.speed_mps = -to.speed_mps;
}

TrackedObject object_of(const TrackedObject_& from, dds::Intake& intake) {
  const auto& kinematics = from.kinematics();
  const auto& pose = kinematics.pose_with_covariance();
  const auto& size = from.shape().dimensions();
  TrackedObject to;
  to.id = fnv1a(from.object_id().uuid());
  to.kind = kind_of(from.classification(), intake);
  to.existence_probability = intake.number(static_cast<double>(from.existence_probability()));
  to.position = point_of(pose.pose().position(), intake) - 0.5 * intake.number(size.z()) * Point::UnitZ();
  take_motion(kinematics, intake, to);
  to.position_stddev_m = stddev_of(pose.covariance());
  to.length_m = length_of(intake.number(size.x()));
  to.width_m = length_of(intake.number(size.y()));
  return to;
}

}  // namespace

bool is_tracked_objects(std::span<const std::uint8_t> payload) {
  dds::CdrScanner cdr(payload);
  scan_header(cdr);
  cdr.sequence(msg::MAX_OBJECTS, scan_object);
  return cdr.complete();
}

std::string_view from_ros(const autoware_perception_msgs::msg::dds_::TrackedObjects_& from,
                          const std::string& map_frame_id, TrackedObjects& to) {
  dds::Intake intake;
  to.stamp_ns = stamp_of(from.header(), intake);
  to.in_map_frame = from.header().frame_id() == map_frame_id;
  if (!to.in_map_frame && from.header().frame_id() != kBaseLink) intake.refuse("wrong_frame");
  to.objects.clear();
  for (const TrackedObject_& object : from.objects()) to.objects.push_back(object_of(object, intake));
  return intake.refusal();
}

}  // namespace laneloom::ros2
