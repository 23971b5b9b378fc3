#include "mapping/lanes/road_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mapping/geometry/left_of.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/geometry/reproducible.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kDirection_m = 2.0;    // either way, for a direction without noise
constexpr double kBend_m = 4.0;         // either way, for a curvature without noise
constexpr double kStyleReach_m = 15.0;  // either way; shorter patches of another style are noise
constexpr double kAlongside = 0.8;      // cosine between boundaries of one road
constexpr double kBeyondEnd_m = 0.5;    // half of the usual distance between cross-sections
constexpr double kConfirmed = 3.0;      // log odds of a boundary whose probability is not estimated
constexpr double kSurest = 0.999;       // probability of a boundary
constexpr std::ptrdiff_t kMostBeside = 12;

double log_odds(const Marking& marking) {
  if (marking.existence_probability < 0.0)
    return marking.status == ElementStatus::tentative ? 0.0 : kConfirmed;
  const double p = std::clamp(marking.existence_probability, 1.0 - kSurest, kSurest);
  return geometry::reproducible::log(p / (1.0 - p));
}

/// A boundary that cross-sections meet.
class MetBoundary {
 public:
  MetBoundary(std::size_t index, const boundaries::LaneBoundary& boundary)
      : boundary_(boundary),
        mark_{.boundary = index, .is_edge = boundary.is_edge(), .island = boundary.island},
        along_(boundary.course) {
    mark_.log_odds = log_odds(boundary.marking);
  }

  Mark at(double arc_m, const Point& point) const {
    Mark mark = mark_;
    mark.arc_m = arc_m;
    mark.point = point;
    if (!mark.is_edge)
      mark.dashed =
          markings::dashed_excess_m(boundary_.marking, {arc_m - kStyleReach_m, arc_m + kStyleReach_m}) /
          (2.0 * kStyleReach_m);
    return mark;
  }
  /// The mark in the cross-section through a point that lies no further away than `reach_m`. Empty: there is
  /// none. A boundary that ends just before counts, so that a lane ends at the nearest cross-section rather
  /// than at the last one before.
  std::optional<Mark> beside(const Point& point, const Eigen::Vector2d& ahead, double reach_m) {
    const Projection foot = along_.project(point, reach_m);
    if (foot.distance_m >= reach_m || !geometry::same_level(foot.foot, point)) return std::nullopt;
    const double along = boundary_.course.direction(foot).dot(ahead);
    if (std::abs(along) < kAlongside) return std::nullopt;
    const Eigen::Vector2d away = (foot.foot - point).head<2>();
    if (!foot.inside && std::abs(away.dot(ahead)) > kBeyondEnd_m) return std::nullopt;
    Mark mark = at(foot.arc_m, foot.foot);
    mark.lateral_m = std::copysign(foot.distance_m, along > 0.0 ? -foot.lateral_m : foot.lateral_m);
    if (!foot.inside) {
      mark.lateral_m = cross(ahead, away);
      mark.point.head<2>() = geometry::beside(point, ahead, mark.lateral_m).head<2>();
    }
    if (along < 0.0) mark.turn();
    return mark;
  }
  bool is_edge() const { return mark_.is_edge; }

 private:
  const boundaries::LaneBoundary& boundary_;
  Mark mark_;  ///< what is the same everywhere
  MeasuredPolyline::Cursor along_;
};

/// The boundaries beside one, of many the nearest, from right to left. A cross-section of a crowd of lines
/// need not show all.
std::vector<MetBoundary> boundaries_beside(std::size_t boundary, const boundaries::SectionGraph& road) {
  const std::vector<boundaries::SideBySide>& all = road.beside[boundary];
  std::vector<boundaries::SideBySide> nearest(all.begin(),
                                              all.begin() + std::min(std::ssize(all), kMostBeside));
  std::ranges::sort(nearest, {}, &boundaries::SideBySide::lateral_m);
  std::vector<MetBoundary> met;
  met.reserve(nearest.size());
  for (const boundaries::SideBySide& one : nearest) met.emplace_back(one.other, road.boundaries[one.other]);
  return met;
}

/// Unit direction from one point to another; zero if they are one point.
Eigen::Vector2d heading(const Point& from, const Point& to) { return (to - from).head<2>().normalized(); }

/// Where a boundary that turns back, as round the tip of an island, lies beside itself.
class OtherSide {
 public:
  OtherSide(const Polyline& points, double step_m) : points_(points), step_m_(step_m) {
    ahead_.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      ahead_.push_back(heading(points[i > 0 ? i - 1 : 0], points[std::min(i + 1, points.size() - 1)]));
    turns_ = std::ranges::any_of(
        ahead_, [&](const Eigen::Vector2d& ahead) { return ahead.dot(ahead_.front()) < kTurned; });
  }
  /// The index of the nearest point that runs back beside the point of an index. Empty: there is none.
  std::optional<std::size_t> of(std::size_t i) const {
    std::optional<std::size_t> nearest;
    double nearest_m = kCutReach_m;
    for (std::size_t j = 0; turns_ && j < points_.size(); ++j) {
      if (ahead_[i].dot(ahead_[j]) > -kAlongside) continue;
      const Eigen::Vector2d away = (points_[j] - points_[i]).head<2>();
      if (std::abs(away.dot(ahead_[i])) > step_m_ || away.norm() >= nearest_m ||
          !geometry::same_level(points_[j], points_[i]))
        continue;
      nearest_m = away.norm();
      nearest = j;
    }
    return nearest;
  }

 private:
  static constexpr double kTurned = 0.5;  // cosine to the begin, from where on it may turn back

  const Polyline& points_;
  double step_m_;
  std::vector<Eigen::Vector2d> ahead_{};
  bool turns_ = false;
};

}  // namespace

void RoadCuts::add(const Eigen::Vector2d& ahead, double bend, const Mark& own) {
  rows_.push_back({.cut = {.ahead = ahead, .bend = bend}, .begin = marks_.size(), .count = 1});
  marks_.push_back(own);
}

void RoadCuts::insert(const Mark& mark) {
  Row& row = rows_.back();
  // Marks mostly come from right to left.
  auto place = marks_.end();
  const auto first = marks_.begin() + static_cast<std::ptrdiff_t>(row.begin);
  while (place != first && (place - 1)->lateral_m > mark.lateral_m) --place;
  marks_.insert(place, mark);
  ++row.count;
  if (mark.lateral_m < 0.0) ++row.cut.own;
}

void RoadCuts::look_up(const SdMap& sd_map) {
  if (sd_map.empty()) return;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const RoadCut cut = (*this)[i];
    rows_[i].cut.street_lanes = sd_map.lanes_at(cut.self().point.head<2>(), cut.ahead);
  }
}

bool RoadCuts::has_opposed() const { return std::ranges::any_of(marks_, &Mark::opposed); }

RoadCuts RoadCuts::reversed() const {
  RoadCuts turned;
  turned.rows_.assign(rows_.rbegin(), rows_.rend());
  turned.marks_.assign(marks_.rbegin(), marks_.rend());
  for (Mark& mark : turned.marks_) {
    mark.lateral_m = -mark.lateral_m;
    mark.turn();
  }
  for (Row& row : turned.rows_) {
    row.begin = marks_.size() - row.begin - row.count;
    row.cut.own = row.count - 1 - row.cut.own;
    row.cut.ahead = -row.cut.ahead;
    turned.marks_[row.begin + row.cut.own].opposed = false;
  }
  return turned;
}

RoadCuts cut_along(std::size_t boundary, const boundaries::SectionGraph& road, const LaneConfig& config) {
  const MeasuredPolyline& course = road.boundaries[boundary].course;
  const MetBoundary base(boundary, road.boundaries[boundary]);
  std::vector<MetBoundary> others = boundaries_beside(boundary, road);
  MeasuredPolyline::Cursor behind(course), ahead(course), far_behind(course), far_ahead(course);
  const Polyline points = course.resample(config.step_m);
  const OtherSide other_side(points, config.step_m);
  RoadCuts cuts;
  cuts.reserve(points.size(), others.size() + 1);
  const auto arc_at = [&](std::size_t i) {
    return course.length() * static_cast<double>(i) / static_cast<double>(points.size() - 1);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double arc_m = arc_at(i);
    const Eigen::Vector2d along = heading(behind.at(arc_m - kDirection_m), ahead.at(arc_m + kDirection_m));
    const Eigen::Vector2d from = heading(far_behind.at(arc_m - kBend_m), points[i]),
                          to = heading(points[i], far_ahead.at(arc_m + kBend_m));
    cuts.add(along, std::abs(cross(from, to)) / kBend_m, base.at(arc_m, points[i]));
    for (MetBoundary& other : others)
      if (const auto mark = other.beside(points[i], along,
                                         base.is_edge() && other.is_edge() ? kStreetReach_m : kCutReach_m))
        cuts.insert(*mark);
    if (const auto back = other_side.of(i)) {
      Mark mark = base.at(arc_at(*back), points[*back]);
      mark.lateral_m = cross(along, Eigen::Vector2d((points[*back] - points[i]).head<2>()));
      mark.turn();
      cuts.insert(mark);
    }
  }
  return cuts;
}

}  // namespace laneloom::lanes
