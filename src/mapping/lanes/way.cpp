#include "laneloom/way.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "mapping/geometry/left_of.hpp"
#include "mapping/geometry/reproducible.hpp"
#include "mapping/lanes/lane_ahead.hpp"
#include "mapping/lanes/lane_measures.hpp"
#include "mapping/lanes/way_course.hpp"

namespace laneloom {
namespace {

constexpr double kMinLength_m = 1.0;

/// A place between two stations: the first one, and the share of the step to the second.
struct Between {
  std::size_t i;
  double share;
};

Between between(const Way& way, double s_m) {
  const double last = static_cast<double>(way.stations.size() - 2);
  const auto i = static_cast<std::size_t>(std::clamp(std::floor(s_m / way.step_m), 0.0, last));
  return {i, s_m / way.step_m - static_cast<double>(i)};
}

/// The direction between two stations turns evenly; beyond the ends it stays.
Eigen::Vector2d direction_at(const Way& way, const Between& place) {
  const double share = std::clamp(place.share, 0.0, 1.0);
  return ((1.0 - share) * way.stations[place.i].direction() + share * way.stations[place.i + 1].direction())
      .normalized();
}

Point point_at(const Way& way, const Between& place) {
  const Point &a = way.stations[place.i].point, &b = way.stations[place.i + 1].point;
  if (place.share < 0.0) {
    const Eigen::Vector2d along = place.share * way.step_m * way.stations[place.i].direction();
    return a + Point(along.x(), along.y(), 0.0);
  }
  if (place.share > 1.0) {
    const Eigen::Vector2d along = (place.share - 1.0) * way.step_m * way.stations[place.i + 1].direction();
    return b + Point(along.x(), along.y(), 0.0);
  }
  return a + place.share * (b - a);
}

/// How far a point is ahead of a station.
double ahead_m(const WayStation& station, const Point& point) {
  return station.direction().dot((point - station.point).head<2>());
}

/// The place from a station to the next one where a point is neither ahead nor behind.
Between beside(const Way& way, std::size_t i, const Point& point) {
  double from = 0.0, to = 1.0;
  constexpr int kHalvings = 40;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (from + to);
    const Between place{i, middle};
    const bool ahead = direction_at(way, place).dot((point - point_at(way, place)).head<2>()) > 0.0;
    (ahead ? from : to) = middle;
  }
  return {i, 0.5 * (from + to)};
}

/// The lanes of a way's stations, and how it entered them.
class LaneList {
 public:
  explicit LaneList(Way& way) : way_(way) {}
  void add(const lanes::RoutePiece& piece, double s_m) {
    const Lane* lane = piece.lane.lane;
    if (lane == last_) {
      if (lane != nullptr) way_.lanes.back().range.to_m = s_m;
      return;
    }
    if (last_ != nullptr) way_.lanes.back().range.to_m = s_m;
    if (lane != nullptr)
      way_.lanes.push_back({lane->id, piece.lane.against, piece.entry, {.from_m = s_m, .to_m = s_m}});
    last_ = lane;
  }

 private:
  Way& way_;
  const Lane* last_ = nullptr;
};

void add_stations(const LaneGraph& graph, const lanes::Course& course, const lanes::WayLine& line,
                  double from_m, Way& way) {
  LaneList lanes(way);
  std::unique_ptr<lanes::LaneMeasures> measures;
  std::size_t piece = course.pieces.size();
  const auto steps = static_cast<std::size_t>(way.known_m / way.step_m + 1e-9);
  way.stations.reserve(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i) {
    const double s_m = static_cast<double>(i) * way.step_m;
    const auto [point, direction, curvature_per_m, place] = line.at(from_m + s_m);
    const lanes::RoutePiece& here = course.pieces[place.piece];
    if (place.piece != piece) {
      measures.reset();
      if (here.lane.lane != nullptr) measures = std::make_unique<lanes::LaneMeasures>(graph, here.lane);
      piece = place.piece;
    }
    WayStation& station = way.stations.emplace_back(
        WayStation{.point = point,
                   .heading_rad = geometry::reproducible::atan2(direction.y(), direction.x()),
                   .curvature_per_m = curvature_per_m,
                   .lateral_stddev_m = here.lateral_stddev_m + here.stddev_per_m * place.arc_m,
                   .status = ElementStatus::inferred});
    if (measures) measures->fill(place.arc_m, direction, station);
    lanes.add(here, s_m);
  }
}

/// A station whose lane the map has lost. What a station knew without a lane still holds.
WayStation without_lane(const WayStation& station) {
  return {.point = station.point,
          .heading_rad = station.heading_rad,
          .curvature_per_m = station.curvature_per_m,
          .lateral_stddev_m = station.lane == kNoElement ? station.lateral_stddev_m : kNotKnown_m,
          .status = ElementStatus::inferred};
}

/// The rest of the way before, ahead of the vehicle, as a way without lanes: the map has lost them. Empty:
/// the vehicle is not on that way, or the way ends here.
std::optional<Way> rest_of(const Way& before, WayWish wish, const Eigen::Isometry3d& T_map_body) {
  const WayPlace place = before.to_way(T_map_body.translation());
  const double from_m = std::floor(std::max(place.s_m, 0.0) / before.step_m) * before.step_m;
  const double rest_m = before.length() - from_m;
  if (std::abs(place.d_m) > lanes::kMaxBesidePath_m || place.s_m < -before.step_m || rest_m < before.step_m)
    return std::nullopt;
  const auto first = static_cast<std::size_t>(std::lround(from_m / before.step_m));
  const Eigen::Vector2d heading = T_map_body.linear().col(0).head<2>();
  if (before.stations[first].direction().dot(heading) < lanes::kMinAlongPath * heading.norm())
    return std::nullopt;
  Way way{.wish = wish, .step_m = before.step_m, .known_m = rest_m};
  for (std::size_t i = first; i < before.stations.size(); ++i)
    way.stations.push_back(without_lane(before.stations[i]));
  return way;
}

}  // namespace

Eigen::Vector2d WayStation::direction() const {
  return {geometry::reproducible::cos(heading_rad), geometry::reproducible::sin(heading_rad)};
}

WayPlace Way::to_way(const Point& point) const {
  const auto nearest = std::ranges::min_element(stations, {}, [&](const WayStation& station) {
    return (station.point - point).head<2>().squaredNorm();
  });
  auto i = static_cast<std::size_t>(nearest - stations.begin());
  const double here_m = ahead_m(*nearest, point);
  const bool before_begin = i == 0 && here_m <= 0.0, beyond_end = i + 1 == stations.size() && here_m >= 0.0;
  if (before_begin) return {here_m, cross(nearest->direction(), (point - nearest->point).head<2>())};
  if (beyond_end) return {length() + here_m, cross(nearest->direction(), (point - nearest->point).head<2>())};
  if (here_m < 0.0) --i;
  const Between place = beside(*this, i, point);
  return {step_m * (static_cast<double>(i) + place.share),
          cross(direction_at(*this, place), (point - point_at(*this, place)).head<2>())};
}

Point Way::to_map(const WayPlace& place) const {
  const Between at = between(*this, place.s_m);
  return geometry::beside(point_at(*this, at), direction_at(*this, at), place.d_m);
}

std::optional<Way> way_ahead(const LaneGraph& graph, const Eigen::Isometry3d& T_map_body, WayWish wish,
                             const Way* before, const WayOptions& options) {
  const Way* const kept = before != nullptr && before->is_line() ? before : nullptr;
  const lanes::RouteWish wished{.wish = wish, .before = kept, .turn_m = options.turn_m};
  auto course = lanes::course_of(graph, T_map_body, wished, options.reach_m);
  if (!course) {
    auto rest = kept != nullptr ? rest_of(*kept, wish, T_map_body) : std::nullopt;
    const DirectedLane ahead = lanes::lane_ahead(graph, T_map_body);
    if (ahead.lane != nullptr && (!rest || lanes::find(kept, ahead) != nullptr))
      course = lanes::course_into(graph, ahead, T_map_body, wished, options.reach_m);
    else if (rest)
      course = lanes::course_beyond(graph, *rest, options.reach_m);
    if (!course) return rest;
  }
  if (course->places.size() < 2) return std::nullopt;
  const lanes::WayLine line(course->places);
  const double from_m = std::max(0.0, line.foot(T_map_body.translation()));
  Way way{.wish = wish, .step_m = options.step_m, .change = course->change};
  way.known_m = std::min(options.reach_m, line.drivable_to(from_m) - from_m);
  if (way.known_m < std::max(kMinLength_m, options.step_m)) return std::nullopt;
  add_stations(graph, *course, line, from_m, way);
  const auto doubtful = std::ranges::find_if(
      way.stations, [](const WayStation& station) { return station.status != ElementStatus::confirmed; });
  way.confirmed_m = doubtful == way.stations.end()
                        ? way.known_m
                        : std::min(way.known_m,  // a rounding may let the last station lie beyond it
                                   way.step_m * static_cast<double>(doubtful - way.stations.begin()));
  return way;
}

}  // namespace laneloom
