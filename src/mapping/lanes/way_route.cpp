#include "mapping/lanes/way_route.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "mapping/geometry/levels.hpp"
#include "mapping/geometry/smooth_step.hpp"
#include "mapping/lanes/lane_ahead.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/lanes/way_driven.hpp"

namespace laneloom::lanes {
namespace {

using Turn = Linkage::Turn;

constexpr double kMinGap_m = 3.0;  // a longer one is bridged by a bend, a shorter one by smoothing
constexpr double kBendStep_m = 1.0;
constexpr double kBranch_m = 1.5;        // that a branch lies further aside than the lane that goes on
constexpr double kBeyondBorder_m = 0.5;  // as far the vehicle is in a lane of the way before
constexpr double kLookout_m = 25.0;      // ahead of a lane's end

Turn turn_of(WayWish wish) {
  if (wish == WayWish::left) return Turn::left;
  return wish == WayWish::right ? Turn::right : Turn::straight;
}

/// How far a passage steps to the left from straight ahead.
double left_of_ahead_m(const DirectedLane& from, const Passage& passage) {
  const Polyline line = from.centerline();
  return cross(end_direction(line, End::back), (begin_point(passage.to) - line.back()).head<2>());
}

/// Leaves out passages that step aside where another one of the same turn leads on: the branches of forks.
void leave_out_branches(const DirectedLane& from, std::vector<Passage>& passages) {
  const auto aside_m = [&](const Passage& passage) { return std::abs(left_of_ahead_m(from, passage)); };
  const auto is_branch = [&](const Passage& one) {
    return std::ranges::any_of(passages, [&](const Passage& other) {
      return other.turn == Turn::straight && !other.to.oncoming() &&
             aside_m(one) > aside_m(other) + kBranch_m;
    });
  };
  std::vector<Passage> kept;
  std::ranges::copy_if(passages, std::back_inserter(kept), [&](const Passage& passage) {
    return passage.turn != Turn::straight || !is_branch(passage);
  });
  passages = std::move(kept);
}

bool is_offered(const std::vector<Passage>& passages, Turn turn) {
  return std::ranges::find(passages, turn, &Passage::turn) != passages.end();
}

/// Of passages that lead straight on, leaves those furthest to the side of a turn.
void keep_branch(const DirectedLane& from, Turn side, std::vector<Passage>& passages) {
  const auto to_side_m = [&](const Passage& passage) {
    return (side == Turn::left ? 1.0 : -1.0) * left_of_ahead_m(from, passage);
  };
  double furthest_m = -std::numeric_limits<double>::infinity();
  for (const Passage& passage : passages)
    if (passage.turn == Turn::straight && !passage.to.oncoming())
      furthest_m = std::max(furthest_m, to_side_m(passage));
  std::erase_if(passages, [&](const Passage& passage) {
    return passage.turn == Turn::straight && to_side_m(passage) < furthest_m - kBranch_m;
  });
}

/// Where a lane forks, leaves the passages of the branch that is wished.
void choose_branch(const DirectedLane& from, Turn wished, const RouteWish& wish,
                   std::vector<Passage>& passages) {
  const bool forks_off = wish.turn_m && wished != Turn::straight && !is_offered(passages, wished);
  if (forks_off)
    keep_branch(from, wished, passages);
  else
    leave_out_branches(from, passages);
}

/// The passage to take. A passage that was chosen before stays, even where its turn or its probability is
/// judged anew, unless another one makes the wished turn at last. Null: there is none.
const Passage* chosen(const std::vector<Passage>& passages, Turn wished, const Way* before) {
  for (const Passage& passage : passages) {
    const WayLane* kept = find(before, passage.to);
    if (kept == nullptr || kept->entry == Turn::unknown) continue;
    if (!is_offered(passages, wished) || passage.turn == wished || kept->entry == wished) return &passage;
  }
  return best_passage(passages, wished);
}

bool is_walked(const std::vector<Passage>& way, const DirectedLane& first, const Lane* lane) {
  return lane == first.lane ||
         std::ranges::any_of(way, [&](const Passage& passage) { return passage.to.lane == lane; });
}

/// Whether an edge that was seen lies across the road ahead of a lane's end.
bool is_closed_ahead(const LaneGraph& graph, const DirectedLane& lane) {
  const Polyline line = lane.centerline();
  Point ahead = line.back();
  ahead.head<2>() += kLookout_m * end_direction(line, End::back);
  return std::ranges::any_of(graph.map().boundaries, [&](const Marking& boundary) {
    return boundary.type == MarkingType::roadedge && boundary.status != ElementStatus::inferred &&
           intersect({line.back(), ahead}, boundary.points, geometry::kLevel_m);
  });
}

/// Whether a passage turns off where the road may lead straight on: across an intersection whose far side is
/// not seen yet.
bool turns_off(const LaneGraph& graph, const DirectedLane& from, const Passage& passage) {
  if (passage.turn == Turn::straight || passage.turn == Turn::unknown) return false;
  const bool bends = from.against ? is_between_the_same(*passage.to.lane, *from.lane)
                                  : is_between_the_same(*from.lane, *passage.to.lane);
  return !bends && !is_closed_ahead(graph, from);
}

/// The turn that is wished at the end of a lane, `ahead_m` ahead of the vehicle and behind these passages.
Turn turn_behind(const std::vector<Passage>& passages, const RouteWish& wish, double ahead_m) {
  const Turn wished = turn_of(wish.wish);
  const bool is_there = !wish.turn_m || (wish.turn_m->from_m <= ahead_m && ahead_m <= wish.turn_m->to_m);
  return is_there && !is_offered(passages, wished) ? wished : Turn::straight;
}

/// The passages over `reach_m` from the beginning of a lane. The first one leads into `into`, if that is a
/// lane.
std::vector<Passage> passages_ahead(const LaneGraph& graph, const RouteStart& start, const RouteWish& wish,
                                    double reach_m) {
  std::vector<Passage> way;
  DirectedLane last = start.lane;
  for (double length_m = length(last.lane->centerline); length_m < reach_m;) {
    std::vector<Passage> next = graph.successors(last);
    const bool is_begun = way.empty() && start.into != kNoElement;
    const Turn wished = turn_behind(way, wish, length_m - start.arc_m);
    std::erase_if(next, [&](const Passage& passage) {
      const bool elsewhere = is_begun && passage.to.lane->id != start.into;
      const bool wrong =
          !is_begun && !wish.any_turn && passage.turn != wished && turns_off(graph, last, passage);
      return elsewhere || wrong || is_walked(way, start.lane, passage.to.lane) ||
             !passage.to.lane->is_drivable();
    });
    if (!is_begun) choose_branch(last, wished, wish, next);
    const Passage* best = chosen(next, wished, wish.before);
    if (best == nullptr) break;
    const double gap_m = (begin_point(best->to) - last.centerline().back()).norm();
    last = best->to;
    length_m += std::max(gap_m, length(best->path)) + length(last.lane->centerline);
    way.push_back(*best);
  }
  return way;
}

/// Joins lines to a route.
class RouteBuilder {
 public:
  explicit RouteBuilder(Route& route) : route_(route) {}

  const Route& route() const { return route_; }

  /// Appends what lies ahead of the end. Arc lengths on the line begin with `arc_m`.
  void append(const Polyline& line, const RoutePiece& piece, double arc_m = 0.0) {
    const MeasuredPolyline measured(line);
    double from_m = 0.0;
    if (!route_.points.empty()) {
      from_m = join(measured, piece);
      if (from_m >= measured.length()) return;
    }
    route_.pieces.push_back(piece);
    const std::vector<double> arcs_m = arc_lengths(measured.points());
    if (from_m > 0.0) add(measured.at(from_m), arc_m + from_m);
    for (std::size_t i = 0; i < arcs_m.size(); ++i)
      if (arcs_m[i] >= from_m) add(measured.points()[i], arc_m + arcs_m[i]);
  }

 private:
  /// Bridges the gap to a line. Returns the arc length from which on the line lies ahead of the end.
  double join(const MeasuredPolyline& line, const RoutePiece& piece) {
    const RoutePoint end = route_.points.back();
    const Projection foot = line.project(end.point);
    if (!foot.inside && foot.arc_m > 0.0) return line.length();  // all of the line lies behind the end
    const double from_m = foot.arc_m;
    const Point begin = line.at(from_m);
    const double gap_m = (begin - end.point).head<2>().norm();
    if (!foot.inside && gap_m > kMinGap_m) {
      bridge(begin, line.chord(0.0, kMinGap_m), piece.entry);
    } else {
      route_.joints.push_back({end.along_m + 0.5 * gap_m, std::abs(foot.lateral_m)});
    }
    return from_m;
  }

  /// A cubic in Hermite's basis that leaves and enters along the lines.
  void bridge(const Point& to, const Eigen::Vector2d& entering, Turn entry) {
    Polyline last;
    for (std::size_t i = route_.points.size() - std::min<std::size_t>(4, route_.points.size());
         i < route_.points.size(); ++i)
      last.push_back(route_.points[i].point);
    const Eigen::Vector2d leaving = end_direction(last, End::back);
    const Point from = last.back(), gap = to - from;
    const double gap_m = gap.head<2>().norm();
    const int steps = static_cast<int>(std::ceil(gap_m / kBendStep_m));
    route_.pieces.push_back({.lane = {}, .entry = entry});
    for (int i = 1; i < steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      Point point = from + geometry::smooth_step(t) * gap;
      point.head<2>() += t * (1.0 - t) * gap_m * ((1.0 - t) * leaving - t * entering);
      add(point, 0.0);
    }
  }

  void add(const Point& point, double arc_m) {
    double along_m = 0.0;
    if (!route_.points.empty()) {
      const RoutePoint& last = route_.points.back();
      const double step_m = (point - last.point).head<2>().norm();
      if (step_m < 1e-6) return;
      along_m = last.along_m + step_m;
    }
    route_.points.push_back({point, route_.pieces.size() - 1, arc_m, along_m});
  }

  Route& route_;
};

void append(RouteBuilder& builder, const Passage& passage) {
  if (passage.path.size() >= 2) builder.append(passage.path, {.lane = {}, .entry = passage.turn});
  builder.append(passage.to.centerline(), {passage.to, passage.turn});
}

/// Goes on where others drove, if the route ends before it reaches `to_m`, and through the lanes behind.
/// Returns false where nobody did.
bool append_driven(const LaneGraph& graph, const Way* before, Turn turn, double to_m, RouteBuilder& builder) {
  const Route& route = builder.route();
  if (route.points.size() < 2 || route.points.back().along_m >= to_m) return false;
  Polyline line;
  line.reserve(route.points.size());
  for (const RoutePoint& point : route.points) line.push_back(point.point);
  DrivenPassage driven = driven_on(graph, line.back(), end_direction(line, End::back), turn);
  if (driven.path.size() < 2) return false;
  builder.append(driven.path, {.lane = {}, .entry = turn, .lateral_stddev_m = driven.lateral_stddev_m});
  if (driven.to.lane == nullptr) return true;
  append(builder, {.to = driven.to, .path = {}, .turn = turn});
  const double left_m = to_m - route.points.back().along_m + length(driven.to.lane->centerline);
  for (const Passage& passage : passages_ahead(graph, {.lane = driven.to}, {.before = before}, left_m))
    append(builder, passage);
  return true;
}

/// The lanes and paths behind the start, furthest first, until `behind_m` are reached.
void append_behind(const LaneGraph& graph, const RouteStart& start, double behind_m, RouteBuilder& builder) {
  const DirectedLane back{start.lane.lane, !start.lane.against};
  const double lane_m = length(start.lane.lane->centerline);
  const auto behind =
      passages_ahead(graph, {.lane = back}, {.any_turn = true}, lane_m - start.arc_m + behind_m);
  for (auto passage = behind.rbegin(); passage != behind.rend(); ++passage) {
    const DirectedLane from{passage->to.lane, !passage->to.against};
    const MeasuredPolyline line(from.centerline());
    const double from_m = std::max(0.0, line.length() - behind_m);
    builder.append(line.slice({from_m, line.length()}), {.lane = from}, from_m);
    if (passage->path.size() < 2) continue;
    builder.append({passage->path.rbegin(), passage->path.rend()}, {.lane = {}});
  }
}

std::optional<RouteStart> start_in_lane(const LaneGraph& graph, const Eigen::Isometry3d& T_map_body,
                                        const Way* before) {
  const Lane* own = nullptr;
  double best = 0.0, best_worth = 0.0;
  for (const Lane& lane : graph.map().lanes) {
    const bool is_kept = before != nullptr && std::ranges::count(before->lanes, lane.id, &WayLane::id) > 0;
    const double along = ego_alignment(lane, T_map_body, is_kept ? kBeyondBorder_m : 0.0);
    if (along == 0.0) continue;
    const DirectedLane directed{&lane, along < 0.0};
    const double worth = std::abs(along) + (find(before, directed) != nullptr ? 1.0 : 0.0) +
                         (lane.is_drivable() ? 2.0 : 0.0) - (directed.oncoming() ? 1.0 : 0.0);
    if (worth <= best_worth) continue;
    own = &lane;
    best = along;
    best_worth = worth;
  }
  if (own == nullptr) return std::nullopt;
  const DirectedLane lane{own, best < 0.0};
  return RouteStart{lane, MeasuredPolyline(lane.centerline()).project(T_map_body.translation()).arc_m};
}

/// The path of a linkage, or the gap where it has none.
Polyline path_of(const LaneGraph& graph, const Linkage& linkage) {
  if (linkage.path.size() >= 2) return linkage.path;
  const Lane *from = graph.find(linkage.from), *to = graph.find(linkage.to);
  if (from == nullptr || to == nullptr) return {};
  return {from->centerline.back(), to->centerline.front()};
}

std::optional<RouteStart> start_on_passage(const LaneGraph& graph, const Eigen::Isometry3d& T_map_body,
                                           const Way* before) {
  const Point place = T_map_body.translation();
  const Eigen::Vector2d heading = T_map_body.linear().col(0).head<2>().normalized();
  std::optional<RouteStart> start;
  double best_worth = 0.0;
  for (const Linkage& linkage : graph.map().linkages) {
    const Polyline path = path_of(graph, linkage);
    if (path.empty()) continue;
    const MeasuredPolyline line(path);
    const Projection foot = line.project(place, kMaxBesidePath_m);
    if (!foot.inside || !geometry::may_drive_on(foot.foot, place)) continue;
    const double along = line.direction(foot).dot(heading);
    const bool against = along < 0.0;
    const Lane *from = graph.find(against ? linkage.to : linkage.from),
               *to = graph.find(against ? linkage.from : linkage.to);
    if (from == nullptr || to == nullptr || !to->is_drivable() || std::abs(along) < kMinAlongPath) continue;
    const DirectedLane into{to, against};
    if (into.oncoming()) continue;
    const double worth =
        std::abs(along) - 0.1 * foot.distance_m + 1.0 + (find(before, into) != nullptr ? 1.0 : 0.0);
    if (worth <= best_worth) continue;
    best_worth = worth;
    start = RouteStart{{from, against}, length(from->centerline), to->id};
  }
  return start;
}

/// Whether the passage at a start leads into a lane of the way before.
bool is_kept(const LaneGraph& graph, const RouteStart& start, const Way* before) {
  return find(before, {graph.find(start.into), start.lane.against}) != nullptr;
}

}  // namespace

const WayLane* find(const Way* way, const DirectedLane& lane) {
  if (way == nullptr) return nullptr;
  const auto found = std::ranges::find_if(
      way->lanes, [&](const WayLane& one) { return one.id == lane.lane->id && one.against == lane.against; });
  return found == way->lanes.end() ? nullptr : &*found;
}

std::optional<RouteStart> start_of(const LaneGraph& graph, const Eigen::Isometry3d& T_map_body,
                                   const RouteWish& wish) {
  const auto in_lane = start_in_lane(graph, T_map_body, wish.before);
  if (in_lane && find(wish.before, in_lane->lane) != nullptr) return in_lane;
  // A lane that comes up across a passage that was begun does not end it.
  const auto on_passage = start_on_passage(graph, T_map_body, wish.before);
  if (!in_lane) return on_passage;
  return on_passage && is_kept(graph, *on_passage, wish.before) ? on_passage : in_lane;
}

Route route_through(const LaneGraph& graph, const RouteStart& start, const RouteWish& wish, double behind_m,
                    double ahead_m) {
  Route route;
  RouteBuilder builder(route);
  if (start.arc_m < behind_m) append_behind(graph, start, behind_m - start.arc_m, builder);
  const MeasuredPolyline own(start.lane.centerline());
  const double from_m = std::max(0.0, start.arc_m - behind_m);
  const double vehicle_m = (route.points.empty() ? 0.0 : route.points.back().along_m) + start.arc_m - from_m;
  builder.append(from_m < own.length() ? own.slice({from_m, own.length()}) : own.points(),
                 {.lane = start.lane}, from_m < own.length() ? from_m : 0.0);
  const std::vector<Passage> passages = passages_ahead(graph, start, wish, start.arc_m + ahead_m);
  for (const Passage& passage : passages) append(builder, passage);
  const Turn turn = turn_behind(passages, wish, route.points.back().along_m - vehicle_m);
  append_driven(graph, wish.before, turn, behind_m + ahead_m, builder);
  return route;
}

Route route_into(const LaneGraph& graph, const DirectedLane& lane, const Eigen::Isometry3d& T_map_body,
                 const RouteWish& wish, const Stretch& range) {
  Route route;
  RouteBuilder builder(route);
  builder.append({T_map_body * Point(range.from_m, 0.0, 0.0), T_map_body.translation()}, {.lane = {}});
  append(builder, {.to = lane, .path = {}, .turn = Turn::straight});
  for (const Passage& passage : passages_ahead(graph, {.lane = lane}, wish, range.to_m))
    append(builder, passage);
  return route;
}

std::optional<Route> route_beyond(const LaneGraph& graph, const Way& rest, double ahead_m) {
  Route route;
  RouteBuilder builder(route);
  Polyline line;
  for (const WayStation& station : rest.stations) line.push_back(station.point);
  builder.append(line, {.lane = {}});
  if (!append_driven(graph, &rest, Turn::straight, ahead_m, builder)) return std::nullopt;
  return route;
}

}  // namespace laneloom::lanes
