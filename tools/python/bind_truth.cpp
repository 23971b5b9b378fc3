#include <fmt/format.h>

#include "arguments.hpp"
#include "arrays.hpp"
#include "binding.hpp"
#include "laneloom/element_names.hpp"
#include "pickling.hpp"
#include "simulation/road.hpp"

namespace laneloom::python {
namespace {

constexpr const char* kTruthDoc = R"(The truth of a road: what is painted on it, and where its lanes are.

name: of the road
markings: TruthMarking objects
lanes: TruthLane objects
driving_side: "right" or "left"

ValueError: an id is 0 or given twice, or a lane refers to one that the road does not have.)";

constexpr const char* kMarkingDoc = R"(A painted marking or an edge of the road.

id: above 0, and no other marking's
type: "laneline", "roadedge" or "stopline"
points: array (N, 3), N >= 2, metres in the map frame
style: "unknown", "solid" or "dashed")";

constexpr const char* kLaneDoc = R"(A lane between two borders.

id: above 0, and no other lane's
left, right, centerline: arrays (N, 3), N >= 2, metres in the map frame, in driving direction
left_marking, right_marking: ids of the markings that the borders are on; 0: unpainted
in_intersection: whether the lane is within an intersection
successors: ids of the lanes that follow)";

enum class Side { right, left };
constexpr std::array kSideNames{"right", "left"};

ElementId element_id(const py::object& value) {
  const ElementId id = count(value, "id");
  if (id == kNoElement) refuse_value("id", "must be above 0");
  return id;
}

simulation::RoadMarking make_marking(const py::object& id, const py::object& type, const py::object& points,
                                     const py::object& style) {
  return {.id = element_id(id),
          .type = word<MarkingType>(type, "type", kTypeNames),
          .style = word<MarkingStyle>(style, "style", kStyleNames),
          .points = line(points, "points")};
}

simulation::RoadLane make_lane(const py::object& id, const py::object& left, const py::object& right,
                               const py::object& centerline, const py::object& left_marking,
                               const py::object& right_marking, const py::object& in_intersection,
                               const py::object& successors) {
  return {.id = element_id(id),
          .left = line(left, "left"),
          .right = line(right, "right"),
          .centerline = line(centerline, "centerline"),
          .left_marking = count(left_marking, "left_marking"),
          .right_marking = count(right_marking, "right_marking"),
          .in_intersection = boolean(in_intersection, "in_intersection"),
          .successors = list(successors, "successors", count)};
}

simulation::Road make_truth(const py::object& name, const py::object& markings, const py::object& lanes,
                            const py::object& driving_side) {
  simulation::Road road{
      .name = text(name, "name"),
      .right_hand_traffic = word<Side>(driving_side, "driving_side", kSideNames) == Side::right,
      .markings = list(markings, "markings", instance<simulation::RoadMarking>),
      .lanes = list(lanes, "lanes", instance<simulation::RoadLane>)};
  try {
    check_references(road);
  } catch (const std::runtime_error& error) {
    throw py::value_error(error.what());
  }
  return road;
}

simulation::Road load(const py::object& file) {
  const std::string name = existing_path(file, "path");
  const py::gil_scoped_release others_run;
  return simulation::load_truth(name);
}

void save(const simulation::Road& road, const py::object& file) {
  const std::string name = path(file, "path");
  const py::gil_scoped_release others_run;
  save_truth(name, road);
}

void bind_parts(py::module_& module) {
  using py::arg;
  py::class_<simulation::RoadMarking>(module, "TruthMarking", kMarkingDoc)
      .def(py::init(&make_marking), arg("id"), arg("type"), arg("points"), arg("style") = "unknown")
      .def(pickled<simulation::RoadMarking>())
      .def_property_readonly("id", [](const simulation::RoadMarking& m) { return m.id; })
      .def_property_readonly("type", [](const simulation::RoadMarking& m) { return name(m.type); })
      .def_property_readonly("style", [](const simulation::RoadMarking& m) { return name(m.style); })
      .def_property_readonly("points", viewed(&simulation::RoadMarking::points));
  py::class_<simulation::RoadLane>(module, "TruthLane", kLaneDoc)
      .def(py::init(&make_lane), arg("id"), arg("left"), arg("right"), arg("centerline"), py::kw_only(),
           arg("left_marking") = 0, arg("right_marking") = 0, arg("in_intersection") = false,
           arg("successors") = py::tuple())
      .def(pickled<simulation::RoadLane>())
      .def_property_readonly("id", [](const simulation::RoadLane& l) { return l.id; })
      .def_property_readonly("left", viewed(&simulation::RoadLane::left))
      .def_property_readonly("right", viewed(&simulation::RoadLane::right))
      .def_property_readonly("centerline", viewed(&simulation::RoadLane::centerline))
      .def_property_readonly("left_marking", [](const simulation::RoadLane& l) { return l.left_marking; })
      .def_property_readonly("right_marking", [](const simulation::RoadLane& l) { return l.right_marking; })
      .def_property_readonly("in_intersection",
                             [](const simulation::RoadLane& l) { return l.in_intersection; })
      .def_property_readonly("successors", [](const simulation::RoadLane& l) {
        return to_tuple(l.successors, [](ElementId id) { return py::int_(id); });
      });
}

}  // namespace

void bind_truth(py::module_& module) {
  using py::arg;
  bind_parts(module);
  py::class_<simulation::Road>(module, "Truth", kTruthDoc)
      .def(py::init(&make_truth), arg("name") = "", arg("markings") = py::tuple(), arg("lanes") = py::tuple(),
           arg("driving_side") = "right")
      .def_static("load", &load, arg("path"),
                  "The truth in a .truth.json file. RuntimeError: the file is wrong.")
      .def("save", &save, arg("path"), "Writes a .truth.json file.")
      .def(pickled<simulation::Road>())
      .def_property_readonly("name", [](const simulation::Road& r) { return r.name; })
      .def_property_readonly(
          "driving_side", [](const simulation::Road& r) { return r.right_hand_traffic ? "right" : "left"; })
      .def_property_readonly("markings", items_of(&simulation::Road::markings))
      .def_property_readonly("lanes", items_of(&simulation::Road::lanes))
      .def_property_readonly(
          "poses", [](const simulation::Road& r) { return to_tuple(r.drive.poses()); },
          "How the road is driven: Pose objects, whose stamps are times since the start. Empty: not given.")
      .def("__repr__", [](const simulation::Road& r) {
        return fmt::format("<Truth '{}', {} markings, {} lanes>", r.name, r.markings.size(), r.lanes.size());
      });
}

}  // namespace laneloom::python
