#include "mapping/lanes/lane_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/geometry/levels.hpp"
#include "mapping/geometry/smooth_step.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kMaxLongerLeg = 1.25;  // of a turn, as a multiple of the shorter leg
constexpr double kSteepest = 0.12;      // of a road

/// A cubic that begins and ends in the directions of the lanes.
Polyline straight_path(const Lane& from, const Lane& to) {
  const Point a = from.centerline.back(), b = to.centerline.front();
  const double length_m = (b - a).head<2>().norm();
  const Eigen::Vector2d begin = length_m * leaving(from), end = length_m * entering(to);
  const int steps = std::max(1, static_cast<int>(std::ceil(length_m / kPathStep_m)));
  Polyline path;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    Point point = a + geometry::smooth_step(t) * (b - a);  // Hermite's basis
    point.head<2>() += t * (1.0 - t) * ((1.0 - t) * begin - t * end);
    path.push_back(point);
  }
  return path;
}

Point moved(const Point& point, const Eigen::Vector2d& by) { return point + Point(by.x(), by.y(), 0.0); }

/// A Bezier cubic about the corner. It is nearest to an arc if both lanes are equally far from the corner. If
/// one is much further, the path runs straight on from there first: a path that cut the corner would lead
/// over the kerb.
Polyline turning_path(const Lane& from, const Lane& to, const Corner& corner) {
  constexpr double kArc = 0.55;  // share of the way to the corner, for a quarter of a circle
  const double reach_m = kMaxLongerLeg * std::min(corner.before_m, corner.after_m);
  const double before_m = std::min(corner.before_m, reach_m), after_m = std::min(corner.after_m, reach_m);
  const Point &start = from.centerline.back(), &end = to.centerline.front();
  const Point a = moved(start, (corner.before_m - before_m) * leaving(from)),
              d = moved(end, (after_m - corner.after_m) * entering(to));
  const Point b = moved(a, kArc * before_m * leaving(from)), c = moved(d, -kArc * after_m * entering(to));
  const int steps = std::max(2, static_cast<int>(std::ceil(0.8 * (before_m + after_m) / kPathStep_m)));
  Polyline path{start};
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps, s = 1.0 - t;
    path.push_back(s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d);
  }
  path.push_back(end);
  drop_repeats(path);
  const double length_m = length(path);
  const std::vector<double> arc_m = arc_lengths(path);
  for (std::size_t i = 0; i < path.size(); ++i)
    path[i].z() = start.z() + (end.z() - start.z()) * arc_m[i] / length_m;
  return path;
}

}  // namespace

Box box_around(const Polyline& line, double margin_m) {
  const Point margin(margin_m, margin_m, geometry::kLevel_m);
  Box box;
  for (const Point& point : line) box.extend(point);
  return {box.min() - margin, box.max() + margin};
}

std::size_t points_beside(const Polyline& line, const MeasuredPolyline& other, double max_distance_m) {
  return static_cast<std::size_t>(std::ranges::count_if(line, [&](const Point& point) {
    const Projection foot = other.project(point, max_distance_m);
    return foot.inside && foot.distance_m < max_distance_m && geometry::same_level(foot.foot, point);
  }));
}

LaneSide lane_side(const Border& border, Side side) {
  // A lane lies on the right of its left boundary, and the other way round.
  return {{border.boundary, as_seen(opposite(side), border.reversed)}, border.on_boundary, border.reversed};
}

LaneSide side_at_end(const Lane& lane, Side side, End end) {
  const std::vector<Border>& borders = lane.borders(side);
  return lane_side(end == End::back ? borders.back() : borders.front(), side);
}

bool is_between_the_same(const Lane& from, const Lane& to) {
  return std::ranges::all_of(kSides, [&](Side side) {
    if (from.borders(side).empty() || to.borders(side).empty()) return false;
    const LaneSide end = side_at_end(from, side, End::back), begin = side_at_end(to, side, End::front);
    return end.of.boundary != kNoElement && end.of == begin.of && end.reversed == begin.reversed;
  });
}

bool share_boundary(const Lane& lane, Side side, const Lane& across) {
  return std::ranges::any_of(lane.borders(side), [&](const Border& border) {
    return border.boundary != kNoElement &&
           std::ranges::count(across.borders(opposite(side)), border.boundary, &Border::boundary) > 0;
  });
}

LaneSide lane_side(const Lane& lane, Side side) { return lane_side(lane.borders(side).front(), side); }

Linkage::Turn reversed(Linkage::Turn turn) {
  if (turn == Linkage::Turn::left) return Linkage::Turn::right;
  return turn == Linkage::Turn::right ? Linkage::Turn::left : turn;
}

Eigen::Vector2d leaving(const Lane& lane) { return end_direction(lane.centerline, End::back); }
Eigen::Vector2d entering(const Lane& lane) { return -end_direction(lane.centerline, End::front); }
Eigen::Vector2d gap_between(const Lane& from, const Lane& to) {
  return (to.centerline.front() - from.centerline.back()).head<2>();
}
bool may_climb(const Lane& from, const Lane& to) {
  const double climb_m = std::abs(to.centerline.front().z() - from.centerline.back().z());
  return climb_m <= std::max(geometry::kLevel_m, kSteepest * gap_between(from, to).norm());
}

std::optional<Corner> corner_between(const Lane& from, const Lane& to) {
  const Eigen::Vector2d a = leaving(from), b = entering(to), gap = gap_between(from, to);
  const Linkage::Turn turn = turn_between(a, b);
  if (turn != Linkage::Turn::left && turn != Linkage::Turn::right) return std::nullopt;
  const double sine = cross(a, b);
  // from + before * a = to - after * b
  return Corner{cross(gap, b) / sine, cross(a, gap) / sine};
}

bool are_neighbours(const Lane& a, const Lane& b) {
  const auto names = [](const std::vector<Neighbour>& neighbours, ElementId id) {
    return std::ranges::find(neighbours, id, &Neighbour::lane) != neighbours.end();
  };
  return names(a.left_neighbours, b.id) || names(a.right_neighbours, b.id) ||
         names(b.left_neighbours, a.id) || names(b.right_neighbours, a.id);
}

ElementId main_neighbour(const Lane& lane, Side side) {
  const std::vector<Neighbour>& beside = neighbours(lane, side);
  const auto longest = std::ranges::max_element(
      beside, {}, [](const Neighbour& neighbour) { return neighbour.range.length(); });
  return longest == beside.end() ? kNoElement : longest->lane;
}

double ego_sense(const Lane& lane, const Eigen::Isometry3d& T_map_body, double min_cosine) {
  const double along = ego_alignment(lane, T_map_body);
  return along == 0.0 || std::abs(along) < min_cosine ? 0.0 : std::copysign(1.0, along);
}

Polyline path_between(const Lane& from, const Lane& to) {
  if (const auto corner = corner_between(from, to); corner && corner->before_m > 0.0 && corner->after_m > 0.0)
    return turning_path(from, to, *corner);
  return straight_path(from, to);
}

Polyline path_ahead(const Lane& from, const Lane& to) {
  return gap_between(from, to).dot(leaving(from)) < kMinGap_m ? Polyline{} : path_between(from, to);
}

}  // namespace laneloom::lanes
