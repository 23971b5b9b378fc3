#include "mapping/lanes/way_route.hpp"

#include <algorithm>
#include <cmath>

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
constexpr double kBeyondBorder_m = 0.5;  // as far the vehicle is in a lane of the way before

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
    route_.points.reserve(route_.points.size() + measured.points().size() + 1);
    if (from_m > 0.0) add(measured.at(from_m), arc_m + from_m);
    for (std::size_t i = 0; i < measured.points().size(); ++i)
      if (measured.arc_m(i) >= from_m) add(measured.points()[i], arc_m + measured.arc_m(i));
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

/// Appends a path without a lane, and what follows the lane that it leads into, to `to_m` of the route.
void append(const LaneGraph& graph, const PathAhead& ahead, const Way* before, double to_m,
            RouteBuilder& builder) {
  builder.append(ahead.path, {.lane = {},
                              .entry = ahead.turn,
                              .lateral_stddev_m = ahead.lateral_stddev_m,
                              .stddev_per_m = ahead.stddev_per_m});
  if (ahead.to.lane == nullptr) return;
  append(builder, {.to = ahead.to, .path = {}, .turn = ahead.turn});
  const double left_m = to_m - builder.route().points.back().along_m + length(ahead.to.lane->centerline);
  for (const Passage& passage : passages_ahead(graph, {.lane = ahead.to}, {.before = before}, left_m).all)
    append(builder, passage);
}

/// Goes on where others drove, or as the street does, if the route ends before it reaches `to_m`. Returns
/// false where neither leads on.
bool append_path(const LaneGraph& graph, const Way* before, Turn turn, double to_m, RouteBuilder& builder) {
  const Route& route = builder.route();
  if (route.points.size() < 2 || route.points.back().along_m >= to_m) return false;
  Polyline line;
  line.reserve(route.points.size());
  for (const RoutePoint& point : route.points) line.push_back(point.point);
  const Eigen::Vector2d direction = end_direction(line, End::back);
  PathAhead ahead = driven_on(graph, line.back(), direction, turn);
  if (ahead.path.size() < 2 && turn == Turn::straight) ahead = street_on(graph, line.back(), direction);
  if (ahead.path.size() < 2) return false;
  append(graph, ahead, before, to_m, builder);
  return true;
}

/// The lanes and paths behind the start, furthest first, until `behind_m` are reached.
void append_behind(const LaneGraph& graph, const RouteStart& start, double behind_m, RouteBuilder& builder) {
  const DirectedLane back{start.lane.lane, !start.lane.against};
  const double lane_m = length(start.lane.lane->centerline);
  const std::vector<Passage> behind =
      passages_ahead(graph, {.lane = back}, {.any_turn = true}, lane_m - start.arc_m + behind_m).all;
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
    start = RouteStart{.lane = {from, against},
                       .arc_m = length(from->centerline),
                       .into = to->id,
                       .passed_m = against ? line.length() - foot.arc_m : foot.arc_m};
  }
  return start;
}

/// Whether the passage at a start leads into a lane of the way before.
bool is_kept(const LaneGraph& graph, const RouteStart& start, const Way* before) {
  return find(before, {graph.find(start.into), start.lane.against}) != nullptr;
}

}  // namespace

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
  const double vehicle_m =
      (route.points.empty() ? 0.0 : route.points.back().along_m) + start.arc_m - from_m + start.passed_m;
  builder.append(from_m < own.length() ? own.slice({from_m, own.length()}) : own.points(),
                 {.lane = start.lane}, from_m < own.length() ? from_m : 0.0);
  const Passages passages = passages_ahead(graph, start, wish, start.arc_m + ahead_m);
  for (const Passage& passage : passages.all) append(builder, passage);
  const Turn turn = passages.wished(wish, route.points.back().along_m - vehicle_m);
  append_path(graph, wish.before, turn, behind_m + ahead_m, builder);
  return route;
}

Route route_into(const LaneGraph& graph, const DirectedLane& lane, const Eigen::Isometry3d& T_map_body,
                 const RouteWish& wish, const Stretch& range) {
  Route route;
  RouteBuilder builder(route);
  builder.append({T_map_body * Point(range.from_m, 0.0, 0.0), T_map_body.translation()}, {.lane = {}});
  append(builder, {.to = lane, .path = {}, .turn = Turn::straight});
  const double gap_m = (begin_point(lane) - T_map_body.translation()).norm();
  for (const Passage& passage : passages_ahead(graph, {.lane = lane, .arc_m = -gap_m}, wish, range.to_m).all)
    append(builder, passage);
  return route;
}

std::optional<Route> route_beyond(const LaneGraph& graph, const Way& rest, double ahead_m) {
  Route route;
  RouteBuilder builder(route);
  Polyline line;
  for (const WayStation& station : rest.stations) line.push_back(station.point);
  builder.append(line, {.lane = {}});
  if (!append_path(graph, &rest, Turn::straight, ahead_m, builder)) return std::nullopt;
  return route;
}

}  // namespace laneloom::lanes
