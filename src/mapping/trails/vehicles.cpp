#include "mapping/trails/vehicles.hpp"

#include <cmath>

namespace laneloom::trails {
namespace {

constexpr double kMaxStddev_m = 1.0;
constexpr double kMinExistence = 0.5;
constexpr double kMinWidth_m = 1.2;  // a narrower car, truck or bus is a cyclist; -1 is an unknown width

bool is_vehicle(const TrackedObject& object) {
  switch (object.kind) {
    case ObjectKind::car:
    case ObjectKind::truck:
    case ObjectKind::bus:
      return object.width_m < 0.0 || object.width_m >= kMinWidth_m;
    case ObjectKind::motorcycle:
      return true;
    case ObjectKind::unknown:
    case ObjectKind::trailer:  // its tractor has driven there
    case ObjectKind::bicycle:
    case ObjectKind::pedestrian:
      break;
  }
  return false;
}

bool is_sure(const TrackedObject& object) {
  const bool exists = object.existence_probability < 0.0 || object.existence_probability >= kMinExistence;
  return exists && object.position_stddev_m <= kMaxStddev_m;
}

bool has_heading(const TrackedObject& object) { return object.heading.head<2>().norm() > 0.5; }

}  // namespace

bool is_sure_vehicle(const TrackedObject& object) { return is_vehicle(object) && is_sure(object); }

bool is_believed(const TrackedObject& object) { return is_sure_vehicle(object) && has_heading(object); }

bool is_believed_cyclist(const TrackedObject& object) {
  return object.kind == ObjectKind::bicycle && is_sure(object) && has_heading(object);
}

MovingObjects moving_objects(const TrackedObjects& objects) {
  MovingObjects moving;
  for (const TrackedObject& object : objects.objects) {
    const bool is_unknown = object.kind == ObjectKind::unknown;
    if (std::abs(object.speed_mps) <= kMoving_mps || !(is_unknown || is_vehicle(object))) continue;
    if (is_unknown || !is_sure(object))
      ++moving.doubted;
    else
      ++(has_heading(object) ? moving.believed : moving.without_heading);
  }
  return moving;
}

}  // namespace laneloom::trails
