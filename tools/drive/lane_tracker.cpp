#include "drive/lane_tracker.hpp"
#include "mapping/geometry/left_of.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace laneloom::drive {
namespace {

constexpr double kJoint_m = 1.0;  // lanes may meet with a wedge between them
// Distance before a lane's end, from which on a change to a lane that goes on is allowed.
constexpr double kEndsSoon_m = 60.0;
constexpr double kBeside_m = 6.0;       // greatest distance of another lane of the street
constexpr double kMinAlignment = 0.85;  // cosine; more is the same direction
constexpr int kMaxDepth = 12;

double grade_along(const MeasuredPolyline& line, double arc_m) {
  const double from_m = std::max(0.0, arc_m - 2.0), to_m = std::min(line.length(), arc_m + 2.0);
  return (line.at(to_m).z() - line.at(from_m).z()) / std::max(0.1, to_m - from_m);
}

}  // namespace

LaneTracker::LaneTracker(const simulation::Road& road) : road_(road), successors_(road.lanes.size()) {
  std::map<ElementId, std::size_t> index;
  for (std::size_t i = 0; i < road.lanes.size(); ++i) index[road.lanes[i].id] = i;
  lines_.reserve(road.lanes.size());
  for (std::size_t i = 0; i < road.lanes.size(); ++i) {
    const simulation::RoadLane& lane = road.lanes[i];
    lines_.push_back(
        {MeasuredPolyline(lane.centerline), MeasuredPolyline(lane.left), MeasuredPolyline(lane.right)});
    for (const ElementId id : lane.successors) successors_[i].push_back(index.at(id));
  }
}

LaneTracker::Place LaneTracker::place_in(std::size_t lane, const Eigen::Vector2d& centre) const {
  const Lines& lines = lines_[lane];
  Place place;
  place.foot = lines.centre.project(on_ground(centre));
  place.width_m =
      lines.left.project(place.foot.foot).distance_m + lines.right.project(place.foot.foot).distance_m;
  const double lateral_m = std::abs(place.foot.lateral_m);
  const double beyond_m =
      std::sqrt(std::max(0.0, place.foot.distance_m * place.foot.distance_m - lateral_m * lateral_m));
  place.inside = lateral_m <= 0.5 * place.width_m && beyond_m <= kJoint_m;
  return place;
}

bool LaneTracker::goes_on(std::size_t lane, double from_m, double for_m, int depth) const {
  const double rest_m = for_m - (lines_[lane].centre.length() - from_m);
  if (rest_m <= 0.0) return true;
  return depth < kMaxDepth && std::ranges::any_of(successors_[lane], [&](std::size_t next) {
           return goes_on(next, 0.0, rest_m, depth + 1);
         });
}

std::vector<std::size_t> LaneTracker::within_reach() const {
  std::set<std::size_t> reach(lanes_.begin(), lanes_.end());
  for (int hop = 0; hop < 2; ++hop) {
    for (const std::size_t lane : std::vector(reach.begin(), reach.end()))
      reach.insert(successors_[lane].begin(), successors_[lane].end());
  }
  return {reach.begin(), reach.end()};
}

std::vector<std::size_t> LaneTracker::aligned_lanes(const Eigen::Vector2d& centre,
                                                    const Eigen::Vector2d& direction, double within_m) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Projection foot = lines_[i].centre.project(on_ground(centre));
    if (foot.inside && foot.distance_m <= within_m &&
        lines_[i].centre.direction(foot.arc_m).dot(direction) > kMinAlignment)
      found.push_back(i);
  }
  return found;
}

bool LaneTracker::own_ends(const Eigen::Vector2d& centre, double within_m) const {
  return std::ranges::none_of(lanes_, [&](std::size_t lane) {
    return goes_on(lane, lines_[lane].centre.project(on_ground(centre)).arc_m, within_m);
  });
}

bool LaneTracker::settle(const std::vector<std::size_t>& candidates, const Eigen::Vector2d& centre) {
  std::vector<std::size_t> now;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const std::size_t lane : candidates) {
    const Place place = place_in(lane, centre);
    if (!place.inside) continue;
    now.push_back(lane);
    if (std::abs(place.foot.lateral_m) >= nearest_m) continue;
    nearest_m = std::abs(place.foot.lateral_m);
    offset_m_ = place.foot.lateral_m;
    width_m_ = place.width_m;
  }
  if (now.empty()) return false;
  lanes_ = std::move(now);
  return true;
}

LaneTracker::Verdict LaneTracker::move_to(const Eigen::Vector2d& centre, const Eigen::Vector2d& direction) {
  const auto goes_on_here = [&](std::size_t lane) {
    return goes_on(lane, lines_[lane].centre.project(on_ground(centre)).arc_m, kEndsSoon_m);
  };
  if (own_ends(centre, kJoint_m)) {
    const auto beside = aligned_lanes(centre, direction, kBeside_m);
    if (std::ranges::none_of(beside, goes_on_here)) return Verdict::road_ended;
  }
  if (settle(within_reach(), centre)) return Verdict::in_lane;
  std::vector<std::size_t> others = aligned_lanes(centre, direction, kBeside_m);
  const bool changes =
      std::ranges::any_of(others, [&](std::size_t lane) { return place_in(lane, centre).inside; });
  if (own_ends(centre, kEndsSoon_m)) {
    std::erase_if(others, [&](std::size_t lane) { return !goes_on_here(lane); });
    if (settle(others, centre)) return Verdict::in_lane;
  }
  if (changes) return Verdict::changed_lane;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (place_in(i, centre).inside) return Verdict::oncoming;
  }
  return Verdict::off_lanes;
}

bool LaneTracker::in_intersection() const {
  return std::ranges::any_of(lanes_, [&](std::size_t lane) { return road_.lanes[lane].in_intersection; });
}

Eigen::Isometry3d LaneTracker::on_surface(const Bicycle& vehicle) const {
  const auto distance = [&](std::size_t lane) {
    return lines_[lane].centre.project(on_ground(vehicle.rear_axle)).distance_m;
  };
  const Lines& lane = lines_[*std::ranges::min_element(lanes_, {}, distance)];
  const Projection foot = lane.centre.project(on_ground(vehicle.rear_axle));
  const Point left = lane.left.project(foot.foot).foot, right = lane.right.project(foot.foot).foot;
  const Eigen::Vector2d along = lane.centre.direction(foot.arc_m), across = geometry::left_of(along);
  const Eigen::Vector2d gradient =
      grade_along(lane.centre, foot.arc_m) * along +
      (left.z() - right.z()) / std::max(1.0, (left - right).head<2>().norm()) * across;
  const Eigen::Vector2d ahead = vehicle.direction();
  const Point forward = Point(ahead.x(), ahead.y(), gradient.dot(ahead)).normalized();
  const Point up = Point(-gradient.x(), -gradient.y(), 1.0).normalized();
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  T_map_body.linear().col(0) = forward;
  T_map_body.linear().col(1) = up.cross(forward);
  T_map_body.linear().col(2) = up;
  const double height_m = foot.foot.z() + gradient.dot(vehicle.rear_axle - foot.foot.head<2>());
  T_map_body.translation() = Point(vehicle.rear_axle.x(), vehicle.rear_axle.y(), height_m);
  return T_map_body;
}

}  // namespace laneloom::drive
