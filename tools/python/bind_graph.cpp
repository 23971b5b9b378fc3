#include "arguments.hpp"
#include "arrays.hpp"
#include "binding.hpp"
#include "laneloom/lane_graph.hpp"

namespace laneloom::python {
namespace {

constexpr const char* kDoc = R"(The lanes of a map as a planner looks at them.

map: LocalMap)";

/// A graph with the map that it is of.
class OwnedGraph {
 public:
  explicit OwnedGraph(LocalMap map) : map_(std::move(map)), graph_(map_) {}
  OwnedGraph(const OwnedGraph&) = delete;
  OwnedGraph& operator=(const OwnedGraph&) = delete;

  const LaneGraph& graph() const { return graph_; }
  /// The lane of an id. Throws KeyError if the map has no such lane.
  const Lane& lane(ElementId id) const {
    const Lane* found = graph_.find(id);
    if (found == nullptr) throw py::key_error(std::to_string(id));
    return *found;
  }

 private:
  LocalMap map_;
  LaneGraph graph_;
};

py::list ids_of(const OwnedGraph& graph) {
  py::list ids;
  for (const Lane& lane : graph.graph().map().lanes) ids.append(lane.id);
  return ids;
}

py::object or_none(const Lane* lane) { return lane != nullptr ? py::cast(*lane) : py::none(); }

py::object own_lane(const OwnedGraph& graph) {
  const auto own = graph.graph().own_lane(graph.graph().map().T_map_body);
  if (!own) return py::none();
  return py::make_tuple(py::cast(*own->lane.lane), own->arc_m, own->offset_m, own->lane.against);
}

py::list successors(const OwnedGraph& graph, const py::object& id, const py::object& against) {
  py::list ids;
  for (const Passage& passage :
       graph.graph().successors({&graph.lane(count(id, "id")), boolean(against, "against")}))
    ids.append(py::make_tuple(passage.to.lane->id, passage.to.against));
  return ids;
}

py::object at(const OwnedGraph& graph, const py::object& point) {
  const std::vector<double> place = fixed_array(point, "point", {3});
  return or_none(graph.graph().at({place[0], place[1], place[2]}));
}

py::object beside(const OwnedGraph& graph, const py::object& id, const py::object& side,
                  const py::object& arc) {
  constexpr std::array kSides{"left", "right"};
  static_assert(static_cast<int>(Side::left) == 0);
  return or_none(graph.graph().beside({&graph.lane(count(id, "id"))}, word<Side>(side, "side", kSides),
                                      number(arc, "arc")));
}

}  // namespace

void bind_graph(py::module_& module) {
  using py::arg;
  py::class_<OwnedGraph>(module, "LaneGraph", kDoc)
      .def(py::init([](const py::object& map) {
             return std::make_unique<OwnedGraph>(instance<LocalMap>(map, "map"));
           }),
           arg("map"))
      .def(
          "__getitem__", [](const OwnedGraph& g, const py::object& id) { return g.lane(count(id, "id")); },
          arg("id"), "The Lane of an id.")
      .def(
          "__contains__", [](const OwnedGraph& g, const py::object& id) { return ids_of(g).contains(id); },
          arg("id"))
      .def("__iter__", [](const OwnedGraph& g) { return py::iter(ids_of(g)); })
      .def("__len__", [](const OwnedGraph& g) { return g.graph().map().lanes.size(); })
      .def("own_lane", &own_lane,
           "(Lane, arc, offset, against) of the lane that the vehicle drives in; None: it is in none. Metres "
           "along the lane and to its left, as the vehicle drives; against: the vehicle drives against the "
           "order "
           "of the lane's points.")
      .def("at", &at, arg("point"), "The Lane at a point (3,) of the map frame; None: there is none.")
      .def("successors", &successors, arg("id"), arg("against") = false,
           "[(id, against), ...] of the lanes that continue a lane, as it is driven.")
      .def("beside", &beside, arg("id"), arg("side"), arg("arc"),
           "The Lane on a side, \"left\" or \"right\", at so many metres along a lane; None: there is none.");
}

}  // namespace laneloom::python
