#include "pnc/ego_view.hpp"

#include <cmath>
#include <set>

#include "laneloom/lane_graph.hpp"

namespace laneloom::pnc {
namespace {

/// The width at an arc length of a way. Empty: it is not known there, or the way ends before.
std::optional<double> width_on(const Way& way, double arc_m) {
  if (!way.is_line() || arc_m > way.length()) return std::nullopt;
  const double width_m = way.stations[static_cast<std::size_t>(std::lround(arc_m / way.step_m))].width_m;
  return width_m == kNotKnown_m ? std::nullopt : std::optional(width_m);
}

ElementId id_of(const Lane* lane) { return lane == nullptr ? kNoElement : lane->id; }

}  // namespace

EgoView ego_view(const LocalMap& map) {
  EgoView view;
  for (std::size_t i = 0; map.way && i < kLookahead_m.size(); ++i)
    view.width_m[i] = width_on(*map.way, kLookahead_m[i]);
  const LaneGraph graph(map);
  const auto own = graph.own_lane(map.T_map_body);
  if (!own) return view;
  view.lane = own->lane.lane->id;
  view.left_neighbour = id_of(graph.beside(own->lane, Side::left, own->arc_m));
  view.right_neighbour = id_of(graph.beside(own->lane, Side::right, own->arc_m));
  std::set<ElementId> next;
  for (const Passage& passage : graph.successors(own->lane)) next.insert(passage.to.lane->id);
  view.successors.assign(next.begin(), next.end());
  view.offset_m = own->offset_m;
  return view;
}

}  // namespace laneloom::pnc
