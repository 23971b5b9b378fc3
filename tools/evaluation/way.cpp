#include "evaluation/way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

namespace laneloom::evaluation {
namespace {

constexpr double kPathWidth_m = 3.6;
constexpr double kLeastAlignment = 0.7;  // cosine

/// What is left of a line from the vehicle on.
struct Rest {
  double distance_m = std::numeric_limits<double>::infinity();  // from the vehicle to the line
  bool against = false;                                         // the line runs in the opposite sense
  Polyline points;                                              // from the foot to the line's end
};

bool is_near(const Polyline& line, const Point& place, double distance_m) {
  Eigen::AlignedBox2d box;
  for (const Point& point : line) box.extend(point.head<2>());
  return box.exteriorDistance(Eigen::Vector2d(place.head<2>())) <= distance_m;
}

Polyline from_foot(const MeasuredPolyline& line, const Point& place) {
  const double arc_m = line.project(place).arc_m;
  return arc_m < line.length() ? line.slice({arc_m, line.length()}) : Polyline{line.points().back()};
}

/// Empty: the vehicle does not drive along the line.
std::optional<Rest> rest_of(const Polyline& points, double width_m, const Eigen::Isometry3d& T_map_body) {
  const Point place = T_map_body.translation();
  if (points.size() < 2 || !is_near(points, place, 0.5 * width_m)) return std::nullopt;
  const MeasuredPolyline line(points);
  const Projection foot = line.project(place);
  const double alignment = line.direction(foot).dot(T_map_body.linear().col(0).head<2>());
  if (!foot.inside || foot.distance_m > 0.5 * width_m || std::abs(alignment) <= kLeastAlignment)
    return std::nullopt;
  return Rest{foot.distance_m, alignment < 0.0, from_foot(line, place)};
}

const Lane* find_lane(const LocalMap& map, ElementId id) {
  const auto lane =
      std::find_if(map.lanes.begin(), map.lanes.end(), [&](const Lane& other) { return other.id == id; });
  return lane == map.lanes.end() || lane->centerline.empty() ? nullptr : &*lane;
}

void join(const Polyline& next, Way& way) {
  const Eigen::Vector2d gap = (next.front() - way.points.back()).head<2>();
  const Eigen::Vector2d direction = end_direction(way.points, End::back);
  way.joints.push_back({gap.norm(), std::abs(cross(direction, gap))});
  way.points.insert(way.points.end(), next.begin(), next.end());
}

/// How straight a lane leads on from the end of a way: 1 is straight ahead.
double straightness(const Way& way, const Lane& lane) {
  const Eigen::Vector2d to_end = (lane.centerline.back() - way.points.back()).head<2>();
  return end_direction(way.points, End::back).dot(to_end) / std::max(to_end.norm(), 1e-9);
}

const Linkage* straightest(const LocalMap& map, ElementId from, const Way& way) {
  const Linkage* best = nullptr;
  double best_straightness = -std::numeric_limits<double>::infinity();
  for (const Linkage& linkage : map.linkages) {
    const Lane* to = linkage.from == from ? find_lane(map, linkage.to) : nullptr;
    if (to == nullptr || straightness(way, *to) <= best_straightness) continue;
    best = &linkage;
    best_straightness = straightness(way, *to);
  }
  return best;
}

void follow(const LocalMap& map, ElementId lane, double horizon_m, Way& way) {
  std::set<ElementId> walked;
  while (walked.insert(lane).second && length(way.points) < horizon_m) {
    const Linkage* linkage = straightest(map, lane, way);
    if (linkage == nullptr) return;
    if (linkage->path.size() > 1) join(linkage->path, way);
    join(find_lane(map, linkage->to)->centerline, way);
    lane = linkage->to;
  }
}

/// The way from the path of a linkage on; empty where the vehicle drives on none.
Way way_on_path(const LocalMap& map, const Eigen::Isometry3d& T_map_body, double horizon_m) {
  Rest nearest;
  ElementId to = kNoElement;
  for (const Linkage& linkage : map.linkages) {
    const auto rest = rest_of(linkage.path, kPathWidth_m, T_map_body);
    if (!rest || rest->distance_m >= nearest.distance_m) continue;
    nearest = *rest;
    to = linkage.to;
  }
  Way way{.points = nearest.points, .joints = {}, .lane = kNoElement};
  const Lane* next = find_lane(map, to);
  if (way.points.empty() || next == nullptr) return way;
  join(next->centerline, way);
  follow(map, to, horizon_m, way);
  return way;
}

double turn_deg(const Point& first, const Point& middle, const Point& last) {
  const Eigen::Vector2d before = (middle - first).head<2>(), behind = (last - middle).head<2>();
  return std::abs(std::atan2(cross(before, behind), before.dot(behind))) * 180.0 / std::numbers::pi;
}

}  // namespace

Way way_ahead(const LocalMap& map, const Eigen::Isometry3d& T_map_body, double horizon_m) {
  Rest nearest;
  ElementId own = kNoElement;
  for (const Lane& lane : map.lanes) {
    const auto rest = rest_of(lane.centerline, lane.width_m, T_map_body);
    if (!rest || rest->distance_m >= nearest.distance_m) continue;
    nearest = *rest;
    own = lane.id;
  }
  if (nearest.points.empty()) return way_on_path(map, T_map_body, horizon_m);
  if (nearest.against) {
    const Polyline& line = find_lane(map, own)->centerline;
    const MeasuredPolyline backwards(Polyline(line.rbegin(), line.rend()));
    return {.points = from_foot(backwards, T_map_body.translation()), .joints = {}, .lane = own};
  }
  Way way{.points = nearest.points, .joints = {}, .lane = own};
  follow(map, own, horizon_m, way);
  return way;
}

double largest_kink_deg(const Polyline& line) {
  if (line.empty()) return 0.0;
  const MeasuredPolyline measured(line);
  double largest_deg = 0.0;
  for (double arc_m = 2.0; arc_m + 2.0 <= measured.length(); arc_m += 1.0)
    largest_deg = std::max(largest_deg,
                           turn_deg(measured.at(arc_m - 2.0), measured.at(arc_m), measured.at(arc_m + 2.0)));
  return largest_deg;
}

}  // namespace laneloom::evaluation
