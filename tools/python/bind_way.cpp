#include <array>

#include "arguments.hpp"
#include "arrays.hpp"
#include "binding.hpp"
#include "laneloom/element_names.hpp"
#include "laneloom/way.hpp"
#include "pickling.hpp"

namespace laneloom::python {
namespace {

// In the order of WayWish.
constexpr std::array kWishes{"straight", "left", "right", "change_left", "change_right"};

constexpr const char* kWayAheadDoc =
    R"(The way ahead of the vehicle, as a planner wishes it. None: there is nothing to drive on.

map: LocalMap
wish: "straight", "left", "right", "change_left" or "change_right"
before: the Way before, so that the way keeps to a branch that it has chosen, or goes on with a change
reach: greatest length in metres, more than 1
pose: the Pose of the vehicle now, in the map frame; None: that of the map, at its stamp)";

py::object wished_way(const py::object& map, const py::object& wish, const py::object& before,
                      const py::object& reach, const py::object& pose) {
  const LocalMap& given = instance<LocalMap>(map, "map");
  const WayWish wished = word<WayWish>(wish, "wish", kWishes);
  const Way* const last = before.is_none() ? nullptr : &instance<Way>(before, "before");
  const WayOptions options{.reach_m = number(reach, "reach")};
  if (!(options.reach_m > options.step_m)) refuse_value("reach", "must be more than 1");
  const Eigen::Isometry3d T_map_body =
      pose.is_none() ? given.T_map_body : transform(instance<VehiclePose>(pose, "pose"));
  const auto way = way_ahead(LaneGraph(given), T_map_body, wished, last, options);
  return way ? py::cast(*way) : py::none();
}

py::tuple to_way(const Way& way, const py::object& point) {
  const std::vector<double> at = fixed_array(point, "point", {3});
  const WayPlace place = way.to_way({at[0], at[1], at[2]});
  return py::make_tuple(place.s_m, place.d_m);
}

py::array_t<double> to_map(const Way& way, const py::object& s, const py::object& d) {
  return to_array(way.to_map({number(s, "s"), number(d, "d")}));
}

void bind_station(py::module_& module) {
  py::class_<WayStation> station(module, "WayStation",
                                 "The own way at one place. Lengths in metres; -1: not known.");
  station.def(pickled<WayStation>())
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
}

void bind_way_lane(py::module_& module) {
  py::class_<WayLane> lane(module, "WayLane", "A lane that a way goes through.");
  lane.def(pickled<WayLane>())
      .def_property_readonly("id", [](const WayLane& l) { return l.id; })
      .def_property_readonly(
          "against", [](const WayLane& l) { return l.against; },
          "Whether the way walks it against the order of its points.")
      .def_property_readonly(
          "entry", [](const WayLane& l) { return name(l.entry); },
          "The turn into it: \"straight\", \"left\", \"right\" or \"u_turn\"; \"unknown\": the way begins "
          "in it.")
      .def_property_readonly(
          "range", [](const WayLane& l) { return py::make_tuple(l.range.from_m, l.range.to_m); },
          "(from, to), by metres along the way.");
}

void bind_change(py::module_& module) {
  py::class_<LaneChange> change(module, "LaneChange", "A change from one lane to the one beside it.");
  change.def(pickled<LaneChange>())
      .def_property_readonly(
          "from_", [](const LaneChange& c) { return c.from; }, "Id of the lane that is left.")
      .def_property_readonly(
          "to", [](const LaneChange& c) { return c.to; }, "Id of the lane that is entered.")
      .def_property_readonly(
          "begin", [](const LaneChange& c) { return to_array(c.begin); },
          "Array (3,), in the middle of the lane that is left.")
      .def_property_readonly(
          "length", [](const LaneChange& c) { return c.length_m; }, "Metres along the way.");
}

/// None: there is no change.
py::object change_of(const Way& way) {
  return way.change.from == kNoElement ? py::none() : py::cast(way.change);
}

void bind_line(py::module_& module) {
  py::class_<Way> way(module, "Way", "One smooth line ahead, from beside the vehicle.");
  way.def(pickled<Way>())
      .def_property_readonly(
          "wish", [](const Way& w) { return kWishes.at(static_cast<std::size_t>(w.wish)); },
          "As it was given to way_ahead().")
      .def_property_readonly(
          "step", [](const Way& w) { return w.step_m; }, "Metres between stations.")
      .def_property_readonly("stations", [](const Way& w) { return to_tuple(w.stations); })
      .def_property_readonly(
          "lanes", [](const Way& w) { return to_tuple(w.lanes); },
          "In the order in which the way goes through them.")
      .def_property_readonly(
          "known", [](const Way& w) { return w.known_m; }, "Length that the map knows, metres.")
      .def_property_readonly(
          "confirmed", [](const Way& w) { return w.confirmed_m; },
          "Length until the first station that is not confirmed, metres.")
      .def_property_readonly("change", &change_of, "Begun, or done, for this wish; None: neither.")
      .def("to_way", &to_way, py::arg("point"),
           "(s, d): metres along the way, and to its left, of a point (3,) of the map frame.")
      .def("to_map", &to_map, py::arg("s"), py::arg("d"),
           "Array (3,): the point of a place. Undoes to_way().");
  module.def("way_ahead", &wished_way, py::arg("map"), py::arg("wish") = "straight",
             py::arg("before") = py::none(), py::arg("reach") = 60.0, py::arg("pose") = py::none(),
             kWayAheadDoc);
}

void bind_driven_path(py::module_& module) {
  py::class_<DrivenPath> path(module, "DrivenPath",
                              "A path that others drove, where no lane between markings is known.");
  path.def(pickled<DrivenPath>())
      .def_property_readonly("id", [](const DrivenPath& p) { return p.id; })
      .def_property_readonly("points", viewed(&DrivenPath::points),
                             "Array (N, 3), in the order in which they were driven.")
      .def_property_readonly(
          "lateral_stddev", [](const DrivenPath& p) { return p.lateral_stddev_m; }, "Metres.")
      .def_property_readonly(
          "probability", [](const DrivenPath& p) { return p.probability; }, "0..1.");
}

}  // namespace

void bind_way(py::module_& module) {
  bind_station(module);
  bind_way_lane(module);
  bind_change(module);
  bind_line(module);
  bind_driven_path(module);
}

}  // namespace laneloom::python
