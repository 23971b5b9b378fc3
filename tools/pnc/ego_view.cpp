#include "pnc/ego_view.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

/// A lane, walked the way that the vehicle looks.
struct Way {
  const Lane* lane = nullptr;
  bool against = false;  ///< the points' order
};

Polyline centerline(const Way& way) {
  Polyline line = way.lane->centerline;
  if (way.against) std::reverse(line.begin(), line.end());
  return line;
}

double width_at(const Lane& lane, const Point& point) {
  return MeasuredPolyline(lane.left).project(point).distance_m +
         MeasuredPolyline(lane.right).project(point).distance_m;
}

/// The lane whose sides have the vehicle between them; the one it is best aligned with where several do.
Way ego_lane(const LocalMap& map) {
  const Point vehicle = map.T_map_body.translation();
  const Eigen::Vector2d heading = map.T_map_body.linear().col(0).head<2>();
  Way best;
  double best_alignment = 0.5;  // 60 degrees: a lane that crosses is not the vehicle's
  for (const Lane& lane : map.lanes) {
    const Projection left = MeasuredPolyline(lane.left).project(vehicle);
    const Projection right = MeasuredPolyline(lane.right).project(vehicle);
    if (!left.inside || !right.inside || left.lateral_m > 0.0 || right.lateral_m < 0.0) continue;
    const MeasuredPolyline line(lane.centerline);
    const double along = line.direction(line.project(vehicle).arc_m).dot(heading);
    if (std::abs(along) <= best_alignment) continue;
    best_alignment = std::abs(along);
    best = {&lane, along < 0.0};
  }
  return best;
}

const Lane* find(const LocalMap& map, ElementId id) {
  const auto found =
      std::find_if(map.lanes.begin(), map.lanes.end(), [id](const Lane& lane) { return lane.id == id; });
  return found == map.lanes.end() ? nullptr : &*found;
}

std::vector<ElementId> next_lanes(const LocalMap& map, const Way& way) {
  std::set<ElementId> next;
  for (const Linkage& linkage : map.linkages) {
    if (!way.against && linkage.from == way.lane->id) next.insert(linkage.to);
    if (way.against && linkage.to == way.lane->id) next.insert(linkage.from);
  }
  return {next.begin(), next.end()};
}

/// Width `ahead_m` after the arc length `from_m` of the first lane.
std::optional<double> width_ahead(const LocalMap& map, Way way, double from_m, double ahead_m) {
  double arc_m = from_m + ahead_m;
  // A ring of successors ends too: every lane is walked once at most.
  for (std::size_t walked = 0; walked < map.lanes.size(); ++walked) {
    const MeasuredPolyline line(centerline(way));
    if (arc_m <= line.length()) return width_at(*way.lane, line.at(arc_m));
    arc_m -= line.length();
    const std::vector<ElementId> next = next_lanes(map, way);
    way.lane = next.empty() ? nullptr : find(map, next.front());
    if (way.lane == nullptr) break;
  }
  return std::nullopt;
}

/// The neighbour at this place of the centerline.
ElementId beside(const std::vector<Neighbour>& neighbours, double arc_m) {
  const auto found = std::ranges::find_if(neighbours, [arc_m](const Neighbour& neighbour) {
    return neighbour.range.from_m <= arc_m && arc_m <= neighbour.range.to_m;
  });
  return found == neighbours.end() ? kNoElement : found->lane;
}

}  // namespace

EgoView ego_view(const LocalMap& map) {
  EgoView view;
  const Way way = ego_lane(map);
  if (way.lane == nullptr) return view;
  view.lane = way.lane->id;
  const Point vehicle = map.T_map_body.translation();
  const double arc_m = MeasuredPolyline(way.lane->centerline).project(vehicle).arc_m;
  view.left_neighbour = beside(way.against ? way.lane->right_neighbours : way.lane->left_neighbours, arc_m);
  view.right_neighbour = beside(way.against ? way.lane->left_neighbours : way.lane->right_neighbours, arc_m);
  view.successors = next_lanes(map, way);
  const Projection foot = MeasuredPolyline(centerline(way)).project(vehicle);
  view.offset_m = foot.lateral_m;
  for (std::size_t i = 0; i < kLookahead_m.size(); ++i)
    view.width_m[i] = width_ahead(map, way, foot.arc_m, kLookahead_m[i]);
  return view;
}

}  // namespace laneloom
