#include "mapping/topology/road_graph.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/stretches.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::topology {
namespace {

void turn(Lane& lane) {
  for (Polyline* line : {&lane.left, &lane.right, &lane.centerline}) std::ranges::reverse(*line);
  std::swap(lane.left, lane.right);
  const double total_m = length(lane.centerline);
  std::swap(lane.left_borders, lane.right_borders);
  for (const Side side : kSides) {
    std::ranges::reverse(lane.borders(side));
    for (Border& border : lane.borders(side)) {
      border.range = geometry::reversed(border.range, total_m);
      border.reversed = !border.reversed;
    }
  }
  geometry::reverse(lane.inferred_ranges, total_m);
  std::swap(lane.left_neighbours, lane.right_neighbours);
  for (auto* neighbours : {&lane.left_neighbours, &lane.right_neighbours}) {
    std::ranges::reverse(*neighbours);
    for (Neighbour& neighbour : *neighbours) {
      neighbour.range = geometry::reversed(neighbour.range, total_m);
      geometry::reverse(neighbour.crossable, total_m);
    }
  }
}

std::vector<lanes::LaneSide> sides_of(const Lane& lane) {
  std::vector<lanes::LaneSide> sides;
  for (const Side side : kSides)
    for (const Border& border : lane.borders(side))
      if (border.boundary != kNoElement) sides.push_back(lanes::lane_side(border, side));
  return sides;
}

/// Whether two lanes on both sides of one boundary run against one another. Empty: they lie beside none.
std::optional<bool> runs_against(const Lane& lane, const Lane& beside) {
  const std::vector<lanes::LaneSide> across = sides_of(beside);
  for (const lanes::LaneSide& side : sides_of(lane))
    for (const lanes::LaneSide& other : across)
      if (other.of == side.of.other() && geometry::common(other.range, side.range).length() > 0.0)
        return other.reversed != side.reversed;
  return std::nullopt;
}

}  // namespace

void RoadGraph::sort_linkages() {
  std::ranges::stable_sort(linkages, {}, [](const Linkage& l) { return std::tuple(l.from, l.to, l.kind); });
}

void RoadGraph::turn(const std::vector<ElementId>& ids) {
  const auto turned = [&](ElementId id) { return std::ranges::count(ids, id) > 0; };
  for (Lane& lane : lanes)
    if (turned(lane.id)) topology::turn(lane);
  // One of two linked lanes may be turned alone, if directions contradict one another. The linkage does
  // not hold then.
  std::erase_if(linkages, [&](const Linkage& l) { return turned(l.from) != turned(l.to); });
  for (Linkage& linkage : linkages) {
    if (!turned(linkage.from)) continue;
    std::swap(linkage.from, linkage.to);
    linkage.turn = lanes::reversed(linkage.turn);
    std::ranges::reverse(linkage.path);
  }
}

void RoadGraph::rename(const std::map<ElementId, ElementId>& ids) {
  const auto rename = [&](ElementId& id) {
    if (const auto renamed = ids.find(id); renamed != ids.end()) id = renamed->second;
  };
  for (Lane& lane : lanes) {
    rename(lane.id);
    for (auto* neighbours : {&lane.left_neighbours, &lane.right_neighbours})
      for (Neighbour& neighbour : *neighbours) rename(neighbour.lane);
  }
  for (Linkage& linkage : linkages) {
    rename(linkage.from);
    rename(linkage.to);
  }
  std::ranges::sort(lanes, {}, &Lane::id);
  sort_linkages();
}

void RoadGraph::turn_side_strips() {
  for (Lane& strip : side_strips)
    for (const Lane& beside : lanes) {
      const std::optional<bool> against = runs_against(strip, beside);
      if (!against) continue;
      if (*against) topology::turn(strip);
      strip.direction = beside.direction;
      break;
    }
}

}  // namespace laneloom::topology
