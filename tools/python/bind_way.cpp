#include "arrays.hpp"
#include "binding.hpp"
#include "laneloom/element_names.hpp"

namespace laneloom::python {
namespace {

void bind_own_way(py::module_& module) {
  py::class_<WayStation> station(module, "WayStation",
                                 "The own way at one place. Lengths in metres; -1: not known.");
  station
      .def_property_readonly(
          "point", [](const WayStation& s) { return to_array(s.point); }, "Array (3,).")
      .def_property_readonly(
          "heading", [](const WayStation& s) { return s.heading_rad; },
          "Radians from the x axis to the left.")
      .def_property_readonly(
          "curvature", [](const WayStation& s) { return s.curvature_per_m; }, "1/m, positive to the left.")
      .def_property_readonly(
          "lane", [](const WayStation& s) { return s.lane; }, "Id; 0: between two lanes.")
      .def_property_readonly(
          "left", [](const WayStation& s) { return s.left_m; }, "To the lane's left border.")
      .def_property_readonly(
          "right", [](const WayStation& s) { return s.right_m; }, "To the lane's right border.")
      .def_property_readonly("width", [](const WayStation& s) { return s.width_m; })
      .def_property_readonly(
          "lateral_stddev", [](const WayStation& s) { return s.lateral_stddev_m; },
          "Of the middle of the lane.")
      .def_property_readonly("status", [](const WayStation& s) { return name(s.status); })
      .def_property_readonly("may_change_left", [](const WayStation& s) { return s.may_change_left; })
      .def_property_readonly("may_change_right", [](const WayStation& s) { return s.may_change_right; });
  py::class_<Way> way(module, "Way", "One smooth line ahead, straight on from beside the vehicle.");
  way.def_property_readonly(
         "step", [](const Way& w) { return w.step_m; }, "Metres between stations.")
      .def_property_readonly("stations", [](const Way& w) { return to_tuple(w.stations); })
      .def_property_readonly(
          "lanes",
          [](const Way& w) { return to_tuple(w.lanes, [](const WayLane& l) { return py::int_(l.id); }); },
          "Ids, in the order in which the way goes through them.")
      .def_property_readonly(
          "known", [](const Way& w) { return w.known_m; }, "Length that the map knows, metres.")
      .def_property_readonly(
          "confirmed", [](const Way& w) { return w.confirmed_m; },
          "Length until the first station that is not confirmed, metres.");
}

void bind_driven_path(py::module_& module) {
  py::class_<DrivenPath> path(module, "DrivenPath",
                              "A path that others drove, where no lane between markings is known.");
  path.def_property_readonly("id", [](const DrivenPath& p) { return p.id; })
      .def_property_readonly(
          "points", [](const DrivenPath& p) { return to_array(p.points); },
          "Array (N, 3), in the order in which they were driven.")
      .def_property_readonly(
          "lateral_stddev", [](const DrivenPath& p) { return p.lateral_stddev_m; }, "Metres.")
      .def_property_readonly(
          "probability", [](const DrivenPath& p) { return p.probability; }, "0..1.");
}

}  // namespace

void bind_way(py::module_& module) {
  bind_own_way(module);
  bind_driven_path(module);
}

}  // namespace laneloom::python
