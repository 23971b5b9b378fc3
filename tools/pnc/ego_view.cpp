#include "pnc/ego_view.hpp"

#include <algorithm>
#include <set>

#include "laneloom/lane_graph.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::pnc {
namespace {

double width_at(const Lane& lane, const Point& point) {
  return MeasuredPolyline(lane.left).project(point).distance_m +
         MeasuredPolyline(lane.right).project(point).distance_m;
}

/// Width at an arc length from the beginning of `first`, along it and the lanes ahead. Empty: they end
/// before.
std::optional<double> width_ahead(const DirectedLane& first, const std::vector<Passage>& ahead,
                                  double arc_m) {
  const auto width_within = [&arc_m](const DirectedLane& lane) -> std::optional<double> {
    const MeasuredPolyline line(lane.centerline());
    if (arc_m <= line.length()) return width_at(*lane.lane, line.at(arc_m));
    arc_m -= line.length();
    return std::nullopt;
  };
  if (const auto width_m = width_within(first)) return width_m;
  for (const Passage& passage : ahead)
    if (const auto width_m = width_within(passage.to)) return width_m;
  return std::nullopt;
}

ElementId id_of(const Lane* lane) { return lane == nullptr ? kNoElement : lane->id; }

}  // namespace

EgoView ego_view(const LocalMap& map) {
  EgoView view;
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
  const auto ahead = graph.ahead(own->lane, Linkage::Turn::straight, own->arc_m + kLookahead_m.back());
  for (std::size_t i = 0; i < kLookahead_m.size(); ++i)
    view.width_m[i] = width_ahead(own->lane, ahead, own->arc_m + kLookahead_m[i]);
  return view;
}

}  // namespace laneloom::pnc
