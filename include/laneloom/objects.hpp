#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "laneloom/basics.hpp"

/// Vehicles and others that a tracker follows, as plain data; idl/Objects.idl says what each field means.
namespace laneloom {

/// The class of an object. Unknown: the tracker does not tell it.
enum class ObjectKind : std::uint8_t { unknown, car, truck, bus, trailer, motorcycle, bicycle, pedestrian };

/// Words for the classes, in the order of their values.
inline constexpr std::array kObjectKindNames{"unknown", "car",        "truck",   "bus",
                                             "trailer", "motorcycle", "bicycle", "pedestrian"};
inline const char* name(ObjectKind kind) { return kObjectKindNames.at(static_cast<std::size_t>(kind)); }

/// Something that a tracker follows. Lengths that are not known are -1.
struct TrackedObject {
  std::uint64_t id = 0;  ///< stays while the object is followed
  ObjectKind kind = ObjectKind::unknown;
  double existence_probability = -1.0;  ///< 0..1; -1: not estimated
  Point position = Point::Zero();       ///< of the box's centre, on the ground
  Point heading = Point::Zero();        ///< unit vector; zero: unknown, or known up to its sign
  double speed_mps = 0.0;               ///< over ground, along the heading; negative: backwards
  double position_stddev_m = -1.0;      ///< horizontal
  double length_m = -1.0;               ///< along the heading
  double width_m = -1.0;
};

/// Everything that a tracker follows at one instant.
struct TrackedObjects {
  std::int64_t stamp_ns = 0;           ///< sensor clock
  std::uint64_t sequence = 0;          ///< counts up by one per message of the writer
  std::uint64_t session_id = 0;        ///< of the writer's run; ids of objects are valid within it
  std::vector<TrackedObject> objects;  ///< empty: none is followed
  bool in_map_frame = false;           ///< positions and headings are in the map frame, not in the body frame
};

/// The same objects in the body frame. T_map_body is the vehicle's pose at their stamp.
inline TrackedObjects in_body_frame(TrackedObjects objects, const Eigen::Isometry3d& T_map_body) {
  if (!objects.in_map_frame) return objects;
  const Eigen::Isometry3d T_body_map = T_map_body.inverse();
  for (TrackedObject& object : objects.objects) {
    object.position = T_body_map * object.position;
    object.heading = T_body_map.linear() * object.heading;
  }
  objects.in_map_frame = false;
  return objects;
}

/// The same objects in the map frame. T_map_body is the vehicle's pose at their stamp.
inline TrackedObjects in_map_frame(TrackedObjects objects, const Eigen::Isometry3d& T_map_body) {
  if (objects.in_map_frame) return objects;
  for (TrackedObject& object : objects.objects) {
    object.position = T_map_body * object.position;
    object.heading = T_map_body.linear() * object.heading;
  }
  objects.in_map_frame = true;
  return objects;
}

/// Objects in the map frame at another stamp: each goes on along its heading with its speed.
inline TrackedObjects moved_to(std::int64_t stamp_ns, TrackedObjects objects) {
  const double since_s = static_cast<double>(stamp_ns - objects.stamp_ns) * 1e-9;
  for (TrackedObject& object : objects.objects)
    object.position += object.speed_mps * since_s * object.heading;
  objects.stamp_ns = stamp_ns;
  return objects;
}

}  // namespace laneloom
