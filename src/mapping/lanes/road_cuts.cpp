#include "mapping/lanes/road_cuts.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/geometry/levels.hpp"
#include "mapping/geometry/reproducible.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kDirection_m = 2.0;    // either way, for a direction without noise
constexpr double kBend_m = 4.0;         // either way, for a curvature without noise
constexpr double kStyleReach_m = 15.0;  // either way; shorter patches of another style are noise
constexpr double kAlongside = 0.8;      // cosine between boundaries of one road
constexpr double kConfirmed = 3.0;      // log odds of a boundary whose probability is not estimated
constexpr double kSurest = 0.999;       // probability of a boundary

double log_odds(const Marking& marking) {
  if (marking.existence_probability < 0.0)
    return marking.status == ElementStatus::tentative ? 0.0 : kConfirmed;
  const double p = std::clamp(marking.existence_probability, 1.0 - kSurest, kSurest);
  return geometry::reproducible::log(p / (1.0 - p));
}

/// The curvature of a line about an arc length, without sign. 0 at its ends.
double bend_at(const MeasuredPolyline& line, double arc_m) {
  const Eigen::Vector2d before = line.chord(arc_m - kBend_m, arc_m),
                        behind = line.chord(arc_m, arc_m + kBend_m);
  return std::abs(cross(before, behind)) / kBend_m;
}

Mark mark_at(std::size_t index, double arc_m, const Point& point, const boundaries::LaneBoundary& boundary) {
  Mark mark{.boundary = index, .arc_m = arc_m, .point = point, .is_edge = boundary.is_edge()};
  mark.log_odds = log_odds(boundary.marking);
  if (!mark.is_edge)
    mark.dashed =
        markings::dashed_excess_m(boundary.marking, {arc_m - kStyleReach_m, arc_m + kStyleReach_m}) /
        (2.0 * kStyleReach_m);
  return mark;
}

}  // namespace

std::vector<RoadCut> reversed(const std::vector<RoadCut>& cuts) {
  std::vector<RoadCut> turned(cuts.rbegin(), cuts.rend());
  for (RoadCut& cut : turned) {
    std::ranges::reverse(cut.marks);
    cut.own = cut.marks.size() - 1 - cut.own;
    cut.ahead = -cut.ahead;
    for (Mark& mark : cut.marks) {
      mark.lateral_m = -mark.lateral_m;
      if (mark.boundary != cut.self().boundary) mark.opposed = !mark.opposed;
    }
  }
  return turned;
}

std::vector<RoadCut> cut_along(std::size_t boundary, const boundaries::SectionGraph& road,
                               const LaneConfig& config) {
  const boundaries::LaneBoundary& base = road.boundaries[boundary];
  const Polyline points = base.course.resample(config.step_m);
  std::vector<RoadCut> cuts(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double arc_m =
        base.course.length() * static_cast<double>(i) / static_cast<double>(points.size() - 1);
    RoadCut& cut = cuts[i];
    cut.ahead = base.course.chord(arc_m - kDirection_m, arc_m + kDirection_m);
    cut.bend = bend_at(base.course, arc_m);
    cut.marks.push_back(mark_at(boundary, arc_m, points[i], base));
    for (const boundaries::SideBySide& beside : road.beside[boundary]) {
      const boundaries::LaneBoundary& other = road.boundaries[beside.other];
      const double reach_m = base.is_edge() && other.is_edge() ? kStreetReach_m : kCutReach_m;
      const Projection foot = other.course.project(points[i], reach_m);
      if (!foot.inside || foot.distance_m >= reach_m || !geometry::same_level(foot.foot, points[i])) continue;
      const double along = other.course.direction(foot).dot(cut.ahead);
      if (std::abs(along) < kAlongside) continue;
      Mark mark = mark_at(beside.other, foot.arc_m, foot.foot, other);
      mark.lateral_m = std::copysign(foot.distance_m, along > 0.0 ? -foot.lateral_m : foot.lateral_m);
      mark.opposed = along < 0.0;
      cut.marks.push_back(mark);
    }
    std::ranges::stable_sort(cut.marks, {}, &Mark::lateral_m);
    cut.own =
        static_cast<std::size_t>(std::ranges::find(cut.marks, boundary, &Mark::boundary) - cut.marks.begin());
  }
  return cuts;
}

}  // namespace laneloom::lanes
