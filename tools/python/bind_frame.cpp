#include <fmt/format.h>

#include "arguments.hpp"
#include "arrays.hpp"
#include "binding.hpp"
#include "cdr/bounds.hpp"
#include "laneloom/element_names.hpp"
#include "pickling.hpp"
#include "session/gate.hpp"

namespace laneloom::python {
namespace {

constexpr const char* kDetectionDoc = R"(A polyline that a network saw in one frame.

type: "laneline", "roadedge" or "stopline"
points: array (N, 3), N >= 2, in metres, body frame (x forward, y left, z up)
confidence: 0..1
style: "unknown", "solid" or "dashed"
stddev: array (N,), lateral standard deviation of each point in metres; None: not given)";

constexpr const char* kFrameDoc = R"(Everything that a network saw at one instant.

stamp_ns: time of the sensor in nanoseconds, above 0
detections: Detection objects
source: name of the network; each network is a source of its own
detected_types: types that the network can detect; empty: every type
field_of_view: array (N, 3), polygon in the body frame; empty: all of the mapper's range
occluded_areas: arrays (N, 3), polygons in the body frame; what is in them is not seen
sequence, session_id: number of the frame, and of the network's run

ValueError: a coordinate is beyond 10 000 km, a list or text is longer than a message takes (512 detections of 1024 points,
64 areas, 64 bytes of text), or whatever else the service would refuse the frame for.)";

constexpr const char* kTrackedObjectDoc = R"(Something that a tracker follows.

id: stays while it is followed; unique among the objects of one instant
position: array (3,), of the box's centre on the ground, in metres
heading: array (3,), unit vector from rear to front; zeros: unknown, or known up to its sign
kind: "car", "truck", "bus", "trailer", "motorcycle", "bicycle", "pedestrian" or "unknown"
speed: over ground, along the heading, in m/s; negative: backwards
existence: 0..1; -1: not estimated
stddev: of the position, in metres; -1: unknown, as are
length, width: metres)";

constexpr const char* kObjectsDoc = R"(Everything that a tracker follows at one instant.

stamp_ns: time of the sensor in nanoseconds, above 0
objects: TrackedObject objects
in_map_frame: whether positions and headings are in the map frame, not in the body frame
sequence, session_id: number of the message, and of the tracker's run

ValueError: there are more than 256, two have one id, a heading is not of unit length, or whatever else the service
would refuse.)";

constexpr const char* kNextTurnDoc = R"(Where the vehicle's route turns next, as its navigation tells it.

stamp_ns: time of the sensor in nanoseconds, above 0
turn: "left" or "right"; with "straight", "unknown" or "u_turn" the way leads straight on
distance: along the road to the middle of the intersection, in metres

ValueError: the distance is negative, or whatever else the service would refuse.)";

constexpr const char* kPoseDoc = R"(Where the vehicle is in the map frame at one instant.

position: array (3,), metres
orientation: array (4,), unit quaternion x, y, z, w; it takes the body frame to the map frame
stamp_ns: time of the sensor in nanoseconds, above 0

ValueError: the quaternion is not of unit length, or a coordinate is beyond 10 000 km.)";

/// Refuses a message that a service would refuse.
template <class T>
T checked(T message, const char* name) {
  if (const auto why = session::defect(message, GateConfig{}); !why.empty())
    refuse_value(name, "the service would refuse it: " + std::string(why));
  return message;
}

/// Refuses a list that is longer than a message takes.
template <class Element>
std::vector<Element> bounded(std::vector<Element> list, const std::string& name) {
  if (list.size() > dds::kMaxLength<Element>)
    refuse_value(name, fmt::format("must be at most {} long, not {}", dds::kMaxLength<Element>, list.size()));
  return list;
}

/// The items of a list that a message takes.
template <class Read>
auto items(const py::handle& value, const std::string& name, Read read) {
  return bounded(list(value, name, read), name);
}

Polyline bounded_polyline(const py::handle& value, const std::string& name) {
  return bounded(polyline(value, name), name);
}

/// A text that fits into a message.
std::string bounded_text(const py::handle& value, const std::string& name) {
  constexpr std::size_t kMaxBytes = std::remove_cvref_t<decltype(msg::Header().frame_id())>::max_size;
  std::string given = text(value, name);
  if (given.size() > kMaxBytes)
    refuse_value(name, fmt::format("must be at most {} bytes of UTF-8, not {}", kMaxBytes, given.size()));
  if (given.find('\0') != std::string::npos) refuse_value(name, "must have no zero character");
  return given;
}

Detection make_detection(const py::object& type, const py::object& points, const py::object& confidence,
                         const py::object& style, const py::object& stddev) {
  Detection detection{.type = word<MarkingType>(type, "type", kTypeNames),
                      .style = word<MarkingStyle>(style, "style", kStyleNames),
                      .confidence = number(confidence, "confidence"),
                      .points = bounded(line(points, "points"), "points")};
  if (!(detection.confidence >= 0.0 && detection.confidence <= 1.0))
    refuse_value("confidence", "must be 0..1");
  if (stddev.is_none()) return detection;
  detection.stddev_m = fixed_array(stddev, "stddev", {static_cast<py::ssize_t>(detection.points.size())});
  for (const double deviation : detection.stddev_m)
    if (deviation < 0.0) refuse_value("stddev", "must not be negative");
  return detection;
}

DetectionFrame make_frame(const py::object& stamp_ns, const py::object& detections, const py::object& source,
                          const py::object& detected_types, const py::object& field_of_view,
                          const py::object& occluded_areas, const py::object& sequence,
                          const py::object& session_id) {
  const auto type = [](const py::handle& value, const std::string& name) {
    return word<MarkingType>(value, name, kTypeNames);
  };
  return checked(DetectionFrame{.stamp_ns = integer(stamp_ns, "stamp_ns"),
                                .sequence = count(sequence, "sequence"),
                                .session_id = count(session_id, "session_id"),
                                .source = bounded_text(source, "source"),
                                .detected_types = items(detected_types, "detected_types", type),
                                .field_of_view = bounded_polyline(field_of_view, "field_of_view"),
                                .occluded_areas = items(occluded_areas, "occluded_areas", bounded_polyline),
                                .detections = items(detections, "detections", instance<Detection>)},
                 "Frame");
}

Point point(const py::object& value, const char* name) {
  const std::vector<double> values = fixed_array(value, name, {3});
  return {values[0], values[1], values[2]};
}

TrackedObject make_tracked_object(const py::object& id, const py::object& position, const py::object& heading,
                                  const py::object& kind, const py::object& speed,
                                  const py::object& existence, const py::object& stddev,
                                  const py::object& length, const py::object& width) {
  return {.id = count(id, "id"),
          .kind = word<ObjectKind>(kind, "kind", kObjectKindNames),
          .existence_probability = number(existence, "existence"),
          .position = point(position, "position"),
          .heading = point(heading, "heading"),
          .speed_mps = number(speed, "speed"),
          .position_stddev_m = number(stddev, "stddev"),
          .length_m = number(length, "length"),
          .width_m = number(width, "width")};
}

TrackedObjects make_objects(const py::object& stamp_ns, const py::object& objects,
                            const py::object& in_map_frame, const py::object& sequence,
                            const py::object& session_id) {
  return checked(TrackedObjects{.stamp_ns = integer(stamp_ns, "stamp_ns"),
                                .sequence = count(sequence, "sequence"),
                                .session_id = count(session_id, "session_id"),
                                .objects = items(objects, "objects", instance<TrackedObject>),
                                .in_map_frame = boolean(in_map_frame, "in_map_frame")},
                 "Objects");
}

NextTurn make_next_turn(const py::object& stamp_ns, const py::object& turn, const py::object& distance) {
  return checked(NextTurn{.stamp_ns = integer(stamp_ns, "stamp_ns"),
                          .turn = word<Linkage::Turn>(turn, "turn", kTurnNames),
                          .distance_m = number(distance, "distance")},
                 "NextTurn");
}

VehiclePose make_pose(const py::object& position, const py::object& orientation, const py::object& stamp_ns) {
  const std::vector<double> p = fixed_array(position, "position", {3});
  const std::vector<double> q = fixed_array(orientation, "orientation", {4});
  auto pose = checked(VehiclePose{.stamp_ns = integer(stamp_ns, "stamp_ns"),
                                  .position = {p[0], p[1], p[2]},
                                  .orientation = Eigen::Quaterniond(q[3], q[0], q[1], q[2])},
                      "Pose");
  pose.orientation.normalize();  // as the service does
  return pose;
}

VehiclePose pose_of_matrix(const py::object& matrix, const py::object& stamp_ns) {
  const std::vector<double> values = fixed_array(matrix, "matrix", {4, 4});
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> T(values.data());
  const Eigen::Matrix3d rotation = T.topLeftCorner<3, 3>();
  const bool rigid = (rotation * rotation.transpose()).isIdentity(1e-3) && rotation.determinant() > 0.0 &&
                     T.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1));
  if (!rigid) refuse_value("matrix", "must be a rotation and a translation");
  return checked(VehiclePose{.stamp_ns = integer(stamp_ns, "stamp_ns"),
                             .position = T.topRightCorner<3, 1>(),
                             .orientation = Eigen::Quaterniond(rotation).normalized()},
                 "Pose");
}

void bind_detection(py::module_& module) {
  using py::arg;
  py::class_<Detection>(module, "Detection", kDetectionDoc)
      .def(py::init(&make_detection), arg("type"), arg("points"), arg("confidence") = 1.0,
           arg("style") = "unknown", arg("stddev") = py::none())
      .def(pickled<Detection>())
      .def_property_readonly("type", [](const Detection& d) { return name(d.type); })
      .def_property_readonly("style", [](const Detection& d) { return name(d.style); })
      .def_property_readonly("confidence", [](const Detection& d) { return d.confidence; })
      .def_property_readonly("points", viewed(&Detection::points))
      .def_property_readonly("stddev", viewed(&Detection::stddev_m),
                             "Array (N,), or (0,) where it is not given.")
      .def("__repr__", [](const Detection& d) {
        return fmt::format("<Detection {} of {} points, confidence {:.2f}>", name(d.type), d.points.size(),
                           d.confidence);
      });
}

void bind_frames(py::module_& module) {
  using py::arg;
  using Frame = DetectionFrame;
  const auto type_name = [](MarkingType type) { return py::str(name(type)); };
  py::class_<Frame>(module, "Frame", kFrameDoc)
      .def(py::init(&make_frame), arg("stamp_ns"), arg("detections"), arg("source") = "", py::kw_only(),
           arg("detected_types") = py::tuple(), arg("field_of_view") = py::tuple(),
           arg("occluded_areas") = py::tuple(), arg("sequence") = 0, arg("session_id") = 0)
      .def(pickled<Frame>())
      .def_property_readonly("stamp_ns", [](const Frame& f) { return f.stamp_ns; })
      .def_property_readonly("detections", items_of(&Frame::detections))
      .def_property_readonly("source", [](const Frame& f) { return f.source; })
      .def_property_readonly("detected_types",
                             [type_name](const Frame& f) { return to_tuple(f.detected_types, type_name); })
      .def_property_readonly("field_of_view", viewed(&Frame::field_of_view))
      .def_property_readonly("occluded_areas",
                             [](const Frame& f) {
                               return to_tuple(f.occluded_areas,
                                               [](const Polyline& p) { return to_array(p); });
                             })
      .def_property_readonly("sequence", [](const Frame& f) { return f.sequence; })
      .def_property_readonly("session_id", [](const Frame& f) { return f.session_id; })
      .def("__repr__", [](const Frame& f) {
        return fmt::format("<Frame at {} ns, {} detections>", f.stamp_ns, f.detections.size());
      });
}

void bind_tracked_object(py::module_& module) {
  using py::arg;
  const py::tuple zeros = py::make_tuple(0.0, 0.0, 0.0);
  py::class_<TrackedObject>(module, "TrackedObject", kTrackedObjectDoc)
      .def(py::init(&make_tracked_object), arg("id"), arg("position"), arg("heading") = zeros,
           arg("kind") = "car", arg("speed") = 0.0, py::kw_only(), arg("existence") = -1.0,
           arg("stddev") = -1.0, arg("length") = -1.0, arg("width") = -1.0)
      .def(pickled<TrackedObject>())
      .def_property_readonly("id", [](const TrackedObject& o) { return o.id; })
      .def_property_readonly("kind", [](const TrackedObject& o) { return name(o.kind); })
      .def_property_readonly("position", [](const TrackedObject& o) { return to_array(o.position); })
      .def_property_readonly("heading", [](const TrackedObject& o) { return to_array(o.heading); })
      .def_property_readonly("speed", [](const TrackedObject& o) { return o.speed_mps; })
      .def_property_readonly("existence", [](const TrackedObject& o) { return o.existence_probability; })
      .def_property_readonly("stddev", [](const TrackedObject& o) { return o.position_stddev_m; })
      .def_property_readonly("length", [](const TrackedObject& o) { return o.length_m; })
      .def_property_readonly("width", [](const TrackedObject& o) { return o.width_m; })
      .def("__repr__", [](const TrackedObject& o) {
        return fmt::format("<TrackedObject {}: {} at ({:.1f}, {:.1f}), {:.1f} m/s>", o.id, name(o.kind),
                           o.position.x(), o.position.y(), o.speed_mps);
      });
}

void bind_objects(py::module_& module) {
  using py::arg;
  using Objects = TrackedObjects;
  py::class_<Objects>(module, "Objects", kObjectsDoc)
      .def(py::init(&make_objects), arg("stamp_ns"), arg("objects"), py::kw_only(),
           arg("in_map_frame") = false, arg("sequence") = 0, arg("session_id") = 0)
      .def(pickled<Objects>())
      .def_property_readonly("stamp_ns", [](const Objects& o) { return o.stamp_ns; })
      .def_property_readonly("objects", [](const Objects& o) { return to_tuple(o.objects); })
      .def_property_readonly("in_map_frame", [](const Objects& o) { return o.in_map_frame; })
      .def_property_readonly("sequence", [](const Objects& o) { return o.sequence; })
      .def_property_readonly("session_id", [](const Objects& o) { return o.session_id; })
      .def("__repr__", [](const Objects& o) {
        return fmt::format("<Objects at {} ns, {} objects>", o.stamp_ns, o.objects.size());
      });
}

void bind_next_turn(py::module_& module) {
  using py::arg;
  py::class_<NextTurn>(module, "NextTurn", kNextTurnDoc)
      .def(py::init(&make_next_turn), arg("stamp_ns"), arg("turn"), arg("distance"))
      .def(pickled<NextTurn>())
      .def_property_readonly("stamp_ns", [](const NextTurn& t) { return t.stamp_ns; })
      .def_property_readonly("turn", [](const NextTurn& t) { return name(t.turn); })
      .def_property_readonly("distance", [](const NextTurn& t) { return t.distance_m; })
      .def("__repr__", [](const NextTurn& t) {
        return fmt::format("<NextTurn at {} ns: {} in {:.0f} m>", t.stamp_ns, name(t.turn), t.distance_m);
      });
}

void bind_pose(py::module_& module) {
  using py::arg;
  using Pose = VehiclePose;
  py::class_<Pose>(module, "Pose", kPoseDoc)
      .def(py::init(&make_pose), arg("position"), arg("orientation"), arg("stamp_ns") = 1)
      .def_static("from_matrix", &pose_of_matrix, arg("matrix"), arg("stamp_ns") = 1,
                  "Pose of an array (4, 4) that takes the body frame to the map frame.")
      .def(pickled<Pose>())
      .def_property_readonly("stamp_ns", [](const Pose& p) { return p.stamp_ns; })
      .def_property_readonly("position", [](const Pose& p) { return to_array(p.position); })
      .def_property_readonly("orientation", [](const Pose& p) { return to_array(p.orientation); })
      .def_property_readonly(
          "matrix", [](const Pose& p) { return to_array(transform(p)); },
          "Array (4, 4) that takes the body frame to the map frame.")
      .def("__repr__", [](const Pose& p) {
        return fmt::format("<Pose at {} ns, ({:.2f}, {:.2f}, {:.2f})>", p.stamp_ns, p.position.x(),
                           p.position.y(), p.position.z());
      });
}

py::sequence pair_of(const py::handle& value, const std::string& name, const char* expected) {
  if (!py::isinstance<py::sequence>(value) || py::isinstance<py::str>(value) || py::len(value) != 2)
    refuse_type(name, expected, value);
  return py::reinterpret_borrow<py::sequence>(value);
}

}  // namespace

SeenFrame seen_frame(const py::handle& value, const std::string& name) {
  const py::sequence pair = pair_of(value, name, "a pair (Frame, Pose)");
  return {instance<DetectionFrame>(pair[0], name + "[0]"), instance<VehiclePose>(pair[1], name + "[1]")};
}

SeenObjects seen_objects(const py::handle& value, const std::string& name) {
  const py::sequence pair = pair_of(value, name, "a pair (Objects, Pose)");
  return {instance<TrackedObjects>(pair[0], name + "[0]"), instance<VehiclePose>(pair[1], name + "[1]")};
}

std::vector<SeenFrame> frames_in_order(const py::handle& value, const std::string& name) {
  std::vector<SeenFrame> frames = list(value, name, seen_frame);
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (frames[i].frame.stamp_ns < frames[i - 1].frame.stamp_ns)
      refuse_value(name + "[" + std::to_string(i) + "]", "stamps must ascend");
  return frames;
}

void bind_frame(py::module_& module) {
  bind_detection(module);
  bind_frames(module);
  bind_tracked_object(module);
  bind_objects(module);
  bind_next_turn(module);
  bind_pose(module);
}

}  // namespace laneloom::python
