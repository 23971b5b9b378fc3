#include "mapping/lanes/way_driven.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "mapping/geometry/levels.hpp"
#include "mapping/lanes/lane_ahead.hpp"

namespace laneloom::lanes {
namespace {

using Turn = Linkage::Turn;

constexpr double kMaxAside_m = 1.75;  // of the path, from the end; of a lane's begin, from the path
constexpr double kMaxGap_m = 10.0;    // from the end to the begin of the path
constexpr double kMinOnward = 0.9;    // cosine between the path and what it goes on with
constexpr double kLeastOn_m = 5.0;    // of what the path leads on
constexpr double kStraight = 0.7071;  // cosine of the greatest angle of a way straight on, at its end
constexpr double kEndChord_m = 5.0;   // over which the direction at the end of a path is measured

// Whoever turns off shows it on the first metres: into a yard by the angle, into a bay by the offset.
constexpr double kFirst_m = 20.0;
constexpr double kMinAlongFirst = 0.9659;  // 15 degrees

/// The turn along a path, from a direction on.
Turn turn_along(const Polyline& path, const Eigen::Vector2d& ahead) {
  const MeasuredPolyline line(path);
  const Eigen::Vector2d end = line.chord(line.length() - kEndChord_m, line.length());
  if (end.dot(ahead) > kStraight) return Turn::straight;
  return cross(ahead, end) > 0.0 ? Turn::left : Turn::right;
}

/// Whether a path begins straight on from a place.
bool begins_straight(const Polyline& path, const Point& from, const Eigen::Vector2d& ahead) {
  const MeasuredPolyline line(path);
  const double first_m = std::min(kFirst_m, line.length());
  const auto is_ahead = [&](const Point& point) {
    return std::abs(cross(ahead, (point - from).head<2>())) <= kMaxAside_m;
  };
  return line.chord(first_m - kEndChord_m, first_m).dot(ahead) > kMinAlongFirst &&
         std::ranges::all_of(line.slice({0.0, first_m}), is_ahead);
}

/// The part of a path beyond a place.
struct Onward {
  Polyline path;
  double aside_m = 0.0;  ///< of the path, from the place
  double arc_m = 0.0;    ///< of its begin on the whole path
};

/// `ahead` is the direction at the place `end`. Empty: the path does not pass there, within an angle of the
/// cosine `min_along`.
std::optional<Onward> onward(const Polyline& path, const Point& end, const Eigen::Vector2d& ahead,
                             double min_along) {
  const MeasuredPolyline line(path);
  const Projection foot = line.project(end);
  const Eigen::Vector2d gap = (foot.foot - end).head<2>();
  const double aside_m = std::abs(cross(ahead, gap)), ahead_m = ahead.dot(gap);
  const bool begins_ahead = foot.arc_m == 0.0 && ahead_m > 0.0 && ahead_m < kMaxGap_m;
  if (aside_m > kMaxAside_m || !(foot.inside || begins_ahead) || !geometry::same_level(foot.foot, end) ||
      line.direction(foot).dot(ahead) < min_along || line.length() - foot.arc_m < kLeastOn_m)
    return std::nullopt;
  return Onward{line.slice({foot.arc_m, line.length()}), aside_m, foot.arc_m};
}

/// The first lane that begins on a path.
struct Entered {
  DirectedLane lane;
  double arc_m = std::numeric_limits<double>::infinity();  ///< on the path
};

Entered first_entered(const LaneGraph& graph, const MeasuredPolyline& path) {
  Entered first;
  for (const Lane& lane : graph.map().lanes)
    for (const bool against : {false, true}) {
      const DirectedLane directed{&lane, against};
      if (!lane.is_drivable() || directed.oncoming()) continue;
      const Point& begin = begin_point(directed);
      const Projection foot = path.project(begin, kMaxAside_m);
      if (!foot.inside || foot.distance_m > kMaxAside_m || foot.arc_m >= first.arc_m) continue;
      if (foot.arc_m < kLeastOn_m || !geometry::same_level(foot.foot, begin)) continue;
      if (path.direction(foot).dot(begin_direction(directed)) < kMinOnward) continue;
      first = {directed, foot.arc_m};
    }
  return first;
}

/// Whether a way goes on as a street does between two stations: there its deviation grows, without a lane.
bool is_along_street(const WayStation& from, const WayStation& to) {
  return from.lane == kNoElement && to.lane == kNoElement && from.lateral_stddev_m >= 0.0 &&
         from.lateral_stddev_m < to.lateral_stddev_m;
}

/// The passage along a path, into the first lane that begins on it.
PathAhead passage_along(const LaneGraph& graph, Polyline path) {
  const MeasuredPolyline line(path);
  const Entered entered = first_entered(graph, line);
  if (entered.lane.lane == nullptr) return {.path = std::move(path)};
  return {.path = line.slice({0.0, entered.arc_m}), .to = entered.lane};
}

}  // namespace

PathAhead driven_on(const LaneGraph& graph, const Point& end, const Eigen::Vector2d& ahead, Turn turn) {
  std::optional<Onward> nearest;
  double lateral_stddev_m = 0.0;
  for (const DrivenPath& driven : graph.map().driven_paths) {
    auto found = onward(driven.points, end, ahead, kMinOnward);
    if (!found || turn_along(found->path, ahead) != turn) continue;
    if (turn == Turn::straight && !begins_straight(found->path, end, ahead)) continue;
    if (nearest && found->aside_m >= nearest->aside_m) continue;
    nearest = std::move(found);
    lateral_stddev_m = driven.lateral_stddev_m;
  }
  if (!nearest) return {};
  PathAhead passage = passage_along(graph, std::move(nearest->path));
  passage.lateral_stddev_m = lateral_stddev_m;
  passage.turn = turn;
  return passage;
}

PathAhead street_on(const LaneGraph& graph, const Point& end, const Eigen::Vector2d& ahead) {
  if (!graph.map().way) return {};
  const Way& way = *graph.map().way;
  const auto street = std::ranges::adjacent_find(way.stations, is_along_street);
  if (street == way.stations.end()) return {};
  // From the station before on, which is the end of what is known.
  const auto first = street == way.stations.begin() ? street : std::prev(street);
  Polyline line;
  std::transform(first, way.stations.end(), std::back_inserter(line),
                 [](const WayStation& station) { return station.point; });
  auto found = onward(line, end, ahead, kStraight);
  if (!found) return {};
  const double per_m = (std::next(street)->lateral_stddev_m - street->lateral_stddev_m) / way.step_m;
  const double before_m = way.step_m * static_cast<double>(street - first);
  PathAhead passage = passage_along(graph, std::move(found->path));
  passage.lateral_stddev_m = std::max(0.0, street->lateral_stddev_m + per_m * (found->arc_m - before_m));
  passage.stddev_per_m = per_m;
  return passage;
}

}  // namespace laneloom::lanes
