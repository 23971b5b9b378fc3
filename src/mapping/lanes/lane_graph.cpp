#include "laneloom/lane_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "mapping/geometry/levels.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom {
namespace {

using Turn = Linkage::Turn;

constexpr double kMinAlongLane = 0.7;  // cosine between the vehicle's heading and a lane that it drives in
constexpr double kMinTurnSine = 0.77;  // of the angle between the lanes: left and right are 50 to 130 degrees

Polyline walked(Polyline line, bool against) {
  if (against) std::ranges::reverse(line);
  return line;
}

Turn walked(Turn turn, bool against) { return against ? lanes::reversed(turn) : turn; }

Turn turn_onto(const DirectedLane& from, const DirectedLane& to) {
  return laneloom::turn_between(end_direction(from.centerline(), End::back),
                                -end_direction(to.centerline(), End::front));
}

bool may_lie_in(const Lane& lane, const Point& place, double beyond_m) {
  Eigen::AlignedBox2d around;
  for (const Point& point : lane.centerline) around.extend(point.head<2>());
  return around.exteriorDistance(place.head<2>()) <= 0.5 * lane.width_m + beyond_m;
}

/// The foot of a place that lies in a lane, on its centerline.
std::optional<Projection> foot_on(const MeasuredPolyline& centerline, const Lane& lane, const Point& place,
                                  double beyond_m) {
  const Projection foot = centerline.project(place);
  const bool inside = foot.inside && foot.distance_m <= 0.5 * lane.width_m + beyond_m &&
                      geometry::may_drive_on(foot.foot, place);
  return inside ? std::optional(foot) : std::nullopt;
}

}  // namespace

Polyline DirectedLane::centerline() const { return walked(lane->centerline, against); }

bool DirectedLane::oncoming() const {
  return lane->direction == Lane::Direction::both ||
         lane->direction ==
             (against ? Lane::Direction::along_centerline : Lane::Direction::against_centerline);
}

Linkage::Turn turn_between(const Eigen::Vector2d& leaving, const Eigen::Vector2d& entering) {
  const double sine = cross(leaving, entering);
  if (std::abs(sine) >= kMinTurnSine) return sine > 0.0 ? Turn::left : Turn::right;
  return leaving.dot(entering) < 0.0 ? Turn::u_turn : Turn::straight;
}

Linkage::Turn turn_between(const Lane& from, const Lane& to) {
  return turn_between(end_direction(from.centerline, End::back), -end_direction(to.centerline, End::front));
}

std::optional<Projection> foot_in(const Lane& lane, const Point& place) {
  if (!may_lie_in(lane, place, 0.0)) return std::nullopt;
  return foot_on(MeasuredPolyline(lane.centerline), lane, place, 0.0);
}

double ego_alignment(const Lane& lane, const Eigen::Isometry3d& T_map_body, double beyond_m) {
  if (!may_lie_in(lane, T_map_body.translation(), beyond_m)) return 0.0;
  const MeasuredPolyline line(lane.centerline);
  const auto foot = foot_on(line, lane, T_map_body.translation(), beyond_m);
  if (!foot) return 0.0;
  const Eigen::Vector2d heading = T_map_body.linear().col(0).head<2>();
  const double along = line.direction(foot->arc_m).dot(heading);
  return std::abs(along) < kMinAlongLane * heading.norm() ? 0.0 : along / heading.norm();
}

const std::vector<Neighbour>& neighbours(const Lane& lane, Side side) {
  return side == Side::left ? lane.left_neighbours : lane.right_neighbours;
}

LaneGraph::LaneGraph(const LocalMap& map) : map_(map) {
  for (const Lane& lane : map.lanes) lanes_.emplace(lane.id, &lane);
}

const Lane* LaneGraph::find(ElementId id) const {
  const auto found = lanes_.find(id);
  return found == lanes_.end() ? nullptr : found->second;
}

const Lane* LaneGraph::at(const Point& place) const {
  const Lane* nearest = nullptr;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Lane& lane : map_.lanes) {
    const auto foot = foot_in(lane, place);
    if (!foot || foot->distance_m >= nearest_m) continue;
    nearest = &lane;
    nearest_m = foot->distance_m;
  }
  return nearest;
}

std::optional<LanePosition> LaneGraph::own_lane(const Eigen::Isometry3d& T_map_body) const {
  const Lane* own = nullptr;
  double best = 0.0;
  for (const Lane& lane : map_.lanes) {
    const double along = ego_alignment(lane, T_map_body);
    if (along == 0.0) continue;
    const auto worth = [](const Lane& one, double its_along) {
      return std::pair(one.is_drivable(), std::abs(its_along));
    };
    if (own != nullptr && worth(lane, along) <= worth(*own, best)) continue;
    own = &lane;
    best = along;
  }
  if (own == nullptr) return std::nullopt;
  const DirectedLane lane{own, best < 0.0};
  const Projection foot = MeasuredPolyline(lane.centerline()).project(T_map_body.translation());
  return LanePosition{lane, foot.arc_m, foot.lateral_m};
}

std::vector<Passage> LaneGraph::successors(const DirectedLane& lane) const {
  std::vector<Passage> passages;
  for (const Linkage& linkage : map_.linkages) {
    if ((lane.against ? linkage.to : linkage.from) != lane.lane->id) continue;
    const DirectedLane to{find(lane.against ? linkage.from : linkage.to), lane.against};
    if (to.lane == nullptr) continue;
    Passage passage{to, walked(linkage.path, lane.against), walked(linkage.turn, lane.against),
                    linkage.probability};
    if (passage.turn == Turn::unknown) passage.turn = turn_onto(lane, to);
    passages.push_back(std::move(passage));
  }
  return passages;
}

std::vector<Passage> LaneGraph::ahead(const DirectedLane& lane, Linkage::Turn wished, double reach_m) const {
  std::vector<Passage> way;
  std::set<ElementId> walked_lanes{lane.lane->id};
  DirectedLane last = lane;
  for (double length_m = length(lane.lane->centerline); length_m < reach_m;) {
    std::vector<Passage> next = successors(last);
    std::erase_if(next, [&](const Passage& passage) {
      return walked_lanes.contains(passage.to.lane->id) || !passage.to.lane->is_drivable();
    });
    const Passage* best = best_passage(next, wished);
    if (best == nullptr) break;
    if (best->turn == wished) wished = Turn::straight;
    last = best->to;
    walked_lanes.insert(last.lane->id);
    length_m += length(best->path) + length(last.lane->centerline);
    way.push_back(*best);
  }
  return way;
}

const Lane* LaneGraph::beside(const DirectedLane& lane, Side side, double arc_m) const {
  const double at_m = lane.against ? length(lane.lane->centerline) - arc_m : arc_m;
  for (const Neighbour& neighbour : neighbours(*lane.lane, as_seen(side, lane.against)))
    if (neighbour.range.from_m <= at_m && at_m <= neighbour.range.to_m) return find(neighbour.lane);
  return nullptr;
}

const Passage* best_passage(const std::vector<Passage>& passages, Linkage::Turn wished) {
  const auto worth = [wished](const Passage& passage) {
    const double fit = passage.turn == wished ? 2.0 : (passage.turn == Turn::straight ? 1.0 : 0.0);
    return fit + 0.9 * passage.probability - (passage.to.oncoming() ? 1.0 : 0.0);
  };
  const auto best = std::ranges::max_element(passages, {}, worth);
  return best == passages.end() ? nullptr : &*best;
}

}  // namespace laneloom
