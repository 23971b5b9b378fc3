#include <fmt/format.h>

#include "arrays.hpp"
#include "binding.hpp"
#include "laneloom/element_names.hpp"
#include "pickling.hpp"

namespace laneloom::python {
namespace {

py::tuple pair(const Stretch& range) { return py::make_tuple(range.from_m, range.to_m); }
py::tuple pairs(const std::vector<Stretch>& ranges) { return to_tuple(ranges, pair); }

py::tuple words(Evidence evidence) {
  return to_tuple(names(evidence), [](const char* word) { return py::str(word); });
}

void bind_marking(py::module_& module) {
  py::class_<Marking> marking(
      module, "Marking",
      "A painted line or an edge of the road, as the map knows it. Points are in the map "
      "frame, metres.");
  const auto style = [](const StyleRange& s) {
    return py::make_tuple(s.range.from_m, s.range.to_m, name(s.style));
  };
  marking.def(pickled<Marking>())
      .def_property_readonly("id", [](const Marking& m) { return m.id; })
      .def_property_readonly(
          "type", [](const Marking& m) { return name(m.type); },
          "\"laneline\", \"roadedge\" or \"stopline\".")
      .def_property_readonly(
          "status", [](const Marking& m) { return name(m.status); },
          "\"tentative\", \"confirmed\" or \"inferred\".")
      .def_property_readonly("points", viewed(&Marking::points), "Array (N, 3).")
      .def_property_readonly(
          "styles", [style](const Marking& m) { return to_tuple(m.styles, style); },
          "(from, to, style), by metres along the points, in order.")
      .def_property_readonly("lateral_stddev", viewed(&Marking::lateral_stddev_m),
                             "Array (N,), metres; (0,): not estimated.")
      .def_property_readonly(
          "existence_probability", [](const Marking& m) { return m.existence_probability; },
          "0..1; -1: not estimated.")
      .def_property_readonly("observations", [](const Marking& m) { return m.observations; })
      .def_property_readonly("first_seen_ns", [](const Marking& m) { return m.first_seen_ns; })
      .def_property_readonly("last_seen_ns", [](const Marking& m) { return m.last_seen_ns; });
  marking.def("__repr__", [](const Marking& m) {
    return fmt::format("<Marking {} {}, {} points>", m.id, name(m.type), m.points.size());
  });
}

void bind_stopline(py::module_& module) {
  py::class_<Stopline> stopline(module, "Stopline", "A stopline and the lanes whose traffic waits there.");
  const auto id = [](ElementId value) { return py::int_(value); };
  stopline.def(pickled<Stopline>())
      .def_property_readonly("marking", [](const Stopline& s) { return s.marking; })
      .def_property_readonly(
          "lanes", [id](const Stopline& s) { return to_tuple(s.lanes, id); }, "Ids, ascending.")
      .def_property_readonly(
          "heading", [](const Stopline& s) { return to_array(s.heading); },
          "Array (3,): direction of the traffic that it stops; zero: unknown.");
}

void bind_neighbour(py::module_& module) {
  py::class_<Neighbour> neighbour(module, "Neighbour",
                                  "A lane on the other side of a boundary, along a stretch.");
  neighbour.def(pickled<Neighbour>())
      .def_property_readonly("lane", [](const Neighbour& n) { return n.lane; })
      .def_property_readonly(
          "range", [](const Neighbour& n) { return pair(n.range); },
          "(from, to), by metres along the centerline of the lane that names it.")
      .def_property_readonly(
          "crossable", [](const Neighbour& n) { return pairs(n.crossable); },
          "(from, to) of each stretch where the line between the two is dashed.");
}

void bind_border(py::module_& module) {
  py::class_<Border> border(module, "Border", "What bounds a lane on one side, along a stretch of it.");
  border.def(pickled<Border>())
      .def_property_readonly(
          "boundary", [](const Border& b) { return b.boundary; }, "Id of the map's boundary; 0: unseen.")
      .def_property_readonly(
          "range", [](const Border& b) { return pair(b.range); },
          "(from, to), by metres along the lane's centerline.")
      .def_property_readonly(
          "on_boundary", [](const Border& b) { return pair(b.on_boundary); },
          "(from, to), by metres along the boundary.");
}

void bind_lane(py::module_& module) {
  py::class_<Lane> lane(
      module, "Lane",
      "A lane between two boundaries. Lines are in the map frame, all in the same direction.");
  lane.def(pickled<Lane>())
      .def_property_readonly("id", [](const Lane& l) { return l.id; })
      .def_property_readonly("left", viewed(&Lane::left), "Array (N, 3).")
      .def_property_readonly("right", viewed(&Lane::right), "Array (N, 3).")
      .def_property_readonly("centerline", viewed(&Lane::centerline), "Array (N, 3).")
      .def_property_readonly("left_borders", items_of(&Lane::left_borders),
                             "In order along the centerline, which they cover.")
      .def_property_readonly("right_borders", items_of(&Lane::right_borders),
                             "In order along the centerline, which they cover.")
      .def_property_readonly(
          "width", [](const Lane& l) { return l.width_m; }, "Mean, in metres.")
      .def_property_readonly("left_neighbours", items_of(&Lane::left_neighbours))
      .def_property_readonly("right_neighbours", items_of(&Lane::right_neighbours))
      .def_property_readonly(
          "direction", [](const Lane& l) { return name(l.direction); },
          "Of the traffic: \"unknown\", \"along\" or \"against\" the centerline, or \"both\".")
      .def_property_readonly(
          "direction_probability", [](const Lane& l) { return l.direction_probability; },
          "0..1; -1: the direction is unknown.")
      .def_property_readonly(
          "direction_evidence", [](const Lane& l) { return words(l.direction_evidence); },
          "What tells the direction: \"markings\", \"edges\", \"ego_path\", \"traffic\", \"sd_map\".")
      .def_property_readonly(
          "use", [](const Lane& l) { return name(l.use); },
          "\"unknown\", \"lane\", \"shoulder\", \"parking\" or \"cycle\".")
      .def_property_readonly(
          "use_probability", [](const Lane& l) { return l.use_probability; }, "0..1; -1: not estimated.")
      .def_property_readonly(
          "evidence", [](const Lane& l) { return words(l.evidence); }, "What tells that the lane is there.")
      .def_property_readonly(
          "section", [](const Lane& l) { return l.section; },
          "Lanes of one road section share it, within one map.")
      .def_property_readonly("status", [](const Lane& l) { return name(l.status); })
      .def_property_readonly(
          "existence_probability", [](const Lane& l) { return l.existence_probability; },
          "0..1; -1: not estimated.")
      .def_property_readonly(
          "inferred_ranges", [](const Lane& l) { return pairs(l.inferred_ranges); },
          "(from, to) of each stretch of the centerline beside what was not seen.");
  lane.def("__repr__",
           [](const Lane& l) { return fmt::format("<Lane {}, {:.1f} m wide>", l.id, l.width_m); });
}

void bind_linkage(py::module_& module) {
  py::class_<Linkage> linkage(module, "Linkage", "One lane continues another.");
  linkage.def(pickled<Linkage>())
      .def_property_readonly("from_lane", [](const Linkage& l) { return l.from; })
      .def_property_readonly("to_lane", [](const Linkage& l) { return l.to; })
      .def_property_readonly("kind", [](const Linkage& l) { return name(l.kind); })
      .def_property_readonly(
          "turn", [](const Linkage& l) { return name(l.turn); },
          "\"unknown\", \"straight\", \"left\", \"right\" or \"u_turn\".")
      .def_property_readonly(
          "probability", [](const Linkage& l) { return l.probability; }, "0..1.")
      .def_property_readonly(
          "evidence", [](const Linkage& l) { return words(l.evidence); },
          "What tells that the one lane continues the other.")
      .def_property_readonly("path", viewed(&Linkage::path),
                             "Array (N, 3) across a gap; (0, 3): the lanes meet.");
}

void bind_lineage(py::module_& module) {
  py::class_<LineageEvent> event(module, "LineageEvent", "How an id came to be in the map or left it.");
  event.def(pickled<LineageEvent>())
      .def_property_readonly(
          "kind", [](const LineageEvent& e) { return name(e.kind); },
          "\"born\", \"merged_into\", \"split_from\" or \"retired\".")
      .def_property_readonly(
          "element", [](const LineageEvent& e) { return name(e.element); },
          "What the ids name: \"boundary\", \"stopline\" or \"lane\".")
      .def_property_readonly("id", [](const LineageEvent& e) { return e.id; })
      .def_property_readonly("other", [](const LineageEvent& e) { return e.other; });
}

}  // namespace

void bind_map(py::module_& module) {
  bind_marking(module);
  bind_stopline(module);
  bind_neighbour(module);
  bind_border(module);
  bind_lane(module);
  bind_linkage(module);
  bind_way(module);
  bind_lineage(module);
  py::class_<LocalMap> map(
      module, "LocalMap",
      "The map around the vehicle after one fused frame. Every id that is referred to is in it.");
  map.def(pickled<LocalMap>())
      .def_property_readonly(
          "stamp_ns", [](const LocalMap& m) { return m.stamp_ns; }, "Of the newest fused frame.")
      .def_property_readonly(
          "pose", [](const LocalMap& m) { return to_array(m.T_map_body); },
          "Array (4, 4) that takes the body frame to the map frame, at the stamp.")
      .def_property_readonly("boundaries", items_of(&LocalMap::boundaries),
                             "Markings that bound lanes: lanelines, roadedges, and inferred ones.")
      .def_property_readonly("stoplines", items_of(&LocalMap::stoplines))
      .def_property_readonly("lanes", items_of(&LocalMap::lanes))
      .def_property_readonly("linkages", items_of(&LocalMap::linkages))
      .def_property_readonly(
          "way", [](const LocalMap& m) { return m.way ? py::cast(*m.way) : py::none(); },
          "None: no way is known.")
      .def_property_readonly("driven_paths", items_of(&LocalMap::driven_paths))
      .def_property_readonly("markings", items_of(&LocalMap::markings),
                             "The fused markings of all types; empty in a map that was read from a file.")
      .def_property_readonly("lineage", items_of(&LocalMap::lineage), "Since the map before.");
  map.def("__repr__", [](const LocalMap& m) {
    return fmt::format("<LocalMap at {} ns, {} boundaries, {} lanes>", m.stamp_ns, m.boundaries.size(),
                       m.lanes.size());
  });
}

}  // namespace laneloom::python
