#include "mapping/lanes/way_course.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "mapping/geometry/smooth_step.hpp"
#include "mapping/lanes/lane_changes.hpp"

namespace laneloom::lanes {
namespace {

// The line is smooth from the vehicle on as long as it knows something of what lies behind.
constexpr double kBehind_m = 12.0;
constexpr double kBeyond_m = 6.0;
constexpr double kChange_m = 40.0;
constexpr double kMinChange_m = 15.0;  // where the lane ends soon
// The line between the lanes is crossed within the second and third quarter of a change.
constexpr double kCrossingFrom = 0.25, kCrossingTo = 0.75;

bool is_change(WayWish wish) { return wish == WayWish::change_left || wish == WayWish::change_right; }

/// The place beside the vehicle in a lane, walked in the vehicle's sense.
RouteStart start_beside(const Lane& lane, const Eigen::Isometry3d& T_map_body) {
  const MeasuredPolyline line(lane.centerline);
  const Projection foot = line.project(T_map_body.translation());
  const bool against = line.direction(foot).dot(T_map_body.linear().col(0).head<2>()) < 0.0;
  return {{&lane, against}, against ? line.length() - foot.arc_m : foot.arc_m};
}

Course course_along(const Route& route) {
  return {.pieces = route.pieces, .places = sampled(route), .change = {}};
}

Course course_from(const LaneGraph& graph, const RouteStart& start, const RouteWish& wish, double behind_m,
                   double ahead_m) {
  return course_along(route_through(graph, start, wish, behind_m, ahead_m));
}

Polyline points_of(const Course& course) {
  Polyline points;
  points.reserve(course.places.size());
  for (const RoutePlace& place : course.places) points.push_back(place.point);
  return points;
}

/// Leads from one course over to another, from `begin_m` of the first on.
Course changed_over(const Course& from, const Course& to, double begin_m, double length_m) {
  Course course{.pieces = from.pieces, .places = {}, .change = {}};
  course.pieces.insert(course.pieces.end(), to.pieces.begin(), to.pieces.end());
  const MeasuredPolyline line(points_of(to));
  const auto other = [&](std::size_t i) {
    RoutePlace place = to.places[std::min(i, to.places.size() - 1)];
    place.piece += from.pieces.size();
    return place;
  };
  std::size_t next = 0;
  for (std::size_t i = 0; i < from.places.size(); ++i) {
    const RoutePlace& place = from.places[i];
    const double share = (static_cast<double>(i) * kSample_m - begin_m) / length_m;
    if (share >= 1.0 && i > 0) break;
    const Projection foot = line.project(place.point);
    course.places.push_back(share < 0.5 ? place : other(foot.segment));
    course.places.back().weight = place.weight;
    course.places.back().point = place.point + geometry::smooth_step(share) * (foot.foot - place.point);
    next = static_cast<std::size_t>(std::ceil(foot.arc_m / kSample_m + 0.5));
  }
  for (; next < to.places.size(); ++next) course.places.push_back(other(next));
  return course;
}

/// Where a change can begin, and into which lane.
struct Opening {
  double begin_m = 0.0;  ///< on the course
  double length_m = 0.0;
  std::size_t middle = 0;  ///< index of the place
  DirectedLane to;
};

/// The first stretch from `from_m` on where the lane may be left for the one beside it.
std::optional<Opening> opening_in(const LaneGraph& graph, const Course& course, Side side, double from_m) {
  std::unique_ptr<LaneChanges> changes;
  std::size_t piece = course.pieces.size();
  double free_m = 0.0;  // up to here
  for (std::size_t i = 0; i < course.places.size(); ++i) {
    const RoutePlace& place = course.places[i];
    const DirectedLane& lane = course.pieces[place.piece].lane;
    if (place.piece != piece) {
      changes.reset();
      if (lane.lane != nullptr) changes = std::make_unique<LaneChanges>(graph, lane);
      piece = place.piece;
    }
    const DirectedLane to = changes ? changes->at(side, place.arc_m) : DirectedLane{};
    free_m = to.lane == nullptr ? 0.0 : free_m + kSample_m;
    const double end_m = static_cast<double>(i) * kSample_m;
    const double rest_m = static_cast<double>(course.places.size() - 1) * kSample_m - from_m;
    const double length_m = std::min(kChange_m, rest_m);
    const double begin_m = end_m - kCrossingTo * length_m;
    if (length_m < kMinChange_m || begin_m < from_m || free_m < (kCrossingTo - kCrossingFrom) * length_m)
      continue;
    const auto middle = static_cast<std::size_t>((begin_m + 0.5 * length_m) / kSample_m);
    return Opening{begin_m, length_m, middle, to};
  }
  return std::nullopt;
}

Course with_new_change(const LaneGraph& graph, const Course& own, const Eigen::Isometry3d& T_map_body,
                       const RouteWish& wish) {
  const Side side = wish.wish == WayWish::change_left ? Side::left : Side::right;
  const double vehicle_m = MeasuredPolyline(points_of(own)).project(T_map_body.translation()).arc_m;
  const auto opening = opening_in(graph, own, side, vehicle_m);
  if (!opening) return own;
  const RoutePlace& middle = own.places[opening->middle];
  const double arc_m = MeasuredPolyline(opening->to.centerline()).project(middle.point).arc_m;
  const double behind_m = static_cast<double>(opening->middle) * kSample_m;
  const double ahead_m = static_cast<double>(own.places.size()) * kSample_m - behind_m;
  const Course other = course_from(graph, {opening->to, arc_m}, wish, behind_m, ahead_m);
  Course course = changed_over(own, other, opening->begin_m, opening->length_m);
  const auto begin = static_cast<std::size_t>(opening->begin_m / kSample_m);
  course.change = LaneChange{.from = own.pieces[middle.piece].lane.lane->id,
                             .to = opening->to.lane->id,
                             .begin = own.places[begin].point,
                             .length_m = opening->length_m};
  return course;
}

/// Goes on with a change, on the course on which it was begun. Empty: it is done, or the map has lost one of
/// the two lanes.
std::optional<Course> with_change(const LaneGraph& graph, const LaneChange& change,
                                  const Eigen::Isometry3d& T_map_body, const RouteWish& wish,
                                  double ahead_m) {
  const Lane *from = graph.find(change.from), *to = graph.find(change.to);
  if (from == nullptr || to == nullptr) return std::nullopt;
  const Course own = course_from(graph, start_beside(*from, T_map_body), wish, kBehind_m, ahead_m);
  const Course other = course_from(graph, start_beside(*to, T_map_body), wish, kBehind_m, ahead_m);
  if (own.places.size() < 2 || other.places.size() < 2) return std::nullopt;
  const WayLine line(own.places);
  const double begin_m = line.foot(change.begin);
  if (line.foot(T_map_body.translation()) - begin_m >= change.length_m) return std::nullopt;
  Course course = changed_over(own, other, begin_m, change.length_m);
  course.change = change;
  return course;
}

}  // namespace

std::optional<Course> course_of(const LaneGraph& graph, const Eigen::Isometry3d& T_map_body,
                                const RouteWish& wish, double reach_m) {
  const double ahead_m = reach_m + kBeyond_m;
  const bool goes_on = wish.before != nullptr && wish.before->wish == wish.wish && is_change(wish.wish);
  const LaneChange begun = goes_on ? wish.before->change : LaneChange{};
  if (begun.from != kNoElement)
    if (auto course = with_change(graph, begun, T_map_body, wish, ahead_m)) return course;
  const auto start = start_of(graph, T_map_body, wish);
  if (!start) return std::nullopt;
  Course own = course_from(graph, *start, wish, kBehind_m, ahead_m);
  // A change that had not come to the middle before the map lost it is begun anew.
  const Point begin = T_map_body.inverse() * begun.begin;
  const bool is_over = begun.from != kNoElement && begin.x() < 0.0 && begin.norm() >= 0.5 * begun.length_m;
  if (is_over) own.change = begun;
  if (is_over || !is_change(wish.wish)) return own;
  return with_new_change(graph, own, T_map_body, wish);
}

Course course_into(const LaneGraph& graph, const DirectedLane& lane, const Eigen::Isometry3d& T_map_body,
                   const RouteWish& wish, double reach_m) {
  return course_along(route_into(graph, lane, T_map_body, wish, {-kBehind_m, reach_m + kBeyond_m}));
}

std::optional<Course> course_beyond(const LaneGraph& graph, const Way& rest, double reach_m) {
  const auto route = route_beyond(graph, rest, reach_m + kBeyond_m);
  return route ? std::optional(course_along(*route)) : std::nullopt;
}

}  // namespace laneloom::lanes
