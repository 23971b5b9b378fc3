#include "drive/navigator.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <stdexcept>

#include "laneloom/lane_graph.hpp"
#include "mapping/geometry/levels.hpp"
#include "simulation/route.hpp"

namespace laneloom::drive {
namespace {

constexpr double kSample_m = 4.0;
constexpr double kMaxLaneLateral_m = 2.0;
constexpr double kMinLaneAlignment = 0.9;  // cosine
constexpr std::size_t kPassed = 3;         // lanes that may be passed in one step
constexpr std::size_t kLookahead = 12;     // lanes
constexpr double kAfterIntersection_m = 3.0;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// The lane outside of intersections that a pose is in.
std::size_t lane_of(const simulation::Road& road, const LaneTracker& lanes, const VehiclePose& pose) {
  const Eigen::Vector2d direction = transform(pose).linear().col(0).head<2>().normalized();
  std::size_t best = kNone;
  double best_m = kMaxLaneLateral_m;
  for (std::size_t i = 0; i < road.lanes.size(); ++i) {
    if (road.lanes[i].in_intersection) continue;
    const Projection foot = lanes.centerline(i).project(pose.position);
    if (!foot.inside || foot.distance_m >= best_m || !geometry::same_level(foot.foot, pose.position) ||
        lanes.centerline(i).direction(foot.arc_m).dot(direction) < kMinLaneAlignment)
      continue;
    best = i;
    best_m = foot.distance_m;
  }
  return best;
}

/// Per lane, the successor from which the fewest lanes lead to one of `goals`. kNone: no way leads there.
std::vector<std::size_t> ways_to(const std::vector<std::size_t>& goals,
                                 const std::vector<std::vector<std::size_t>>& successors) {
  std::vector<std::vector<std::size_t>> predecessors(successors.size());
  for (std::size_t i = 0; i < successors.size(); ++i) {
    for (const std::size_t next : successors[i]) predecessors[next].push_back(i);
  }
  std::vector<std::size_t> toward(successors.size(), kNone);
  std::deque<std::size_t> open(goals.begin(), goals.end());
  while (!open.empty()) {
    const std::size_t lane = open.front();
    open.pop_front();
    for (const std::size_t before : predecessors[lane]) {
      if (toward[before] != kNone) continue;
      toward[before] = lane;
      open.push_back(before);
    }
  }
  return toward;
}

}  // namespace

Navigator::Navigator(const simulation::Road& road, const LaneTracker& lanes) : road_(road), lanes_(lanes) {
  const VehiclePose* last = nullptr;
  for (const VehiclePose& pose : road.drive.poses()) {
    if (last != nullptr && (pose.position - last->position).norm() < kSample_m) continue;
    last = &pose;
    const std::size_t lane = lane_of(road, lanes, pose);
    if (lane == kNone || (!drive_.empty() && lane == drive_.back())) continue;
    if (drive_.empty()) {
      drive_.push_back(lane);
      begin_m_ = lanes.centerline(lane).project(pose.position).arc_m;
      continue;
    }
    // A recorded drive may change lanes, where no successors lead.
    const std::vector<std::size_t> way = shortest_way(road, drive_.back(), lane);
    if (!way.empty()) drive_.insert(drive_.end(), way.begin() + 1, way.end());
  }
  if (drive_.empty()) throw std::runtime_error(road.name + ": its drive is on none of its lanes");
  toward_drive_ = ways_to(drive_, lanes.successors());
  at_begin();
}

Navigator::Start Navigator::start_at(std::size_t lane, double arc_m) const {
  const MeasuredPolyline& line = lanes_.centerline(lane);
  const Eigen::Vector2d direction = line.direction(arc_m);
  return {lane,
          {.rear_axle = line.at(arc_m).head<2>(), .heading_rad = std::atan2(direction.y(), direction.x())}};
}

Navigator::Start Navigator::at_begin() {
  driven_to_ = 0;
  plan_from(drive_.front());
  return start_at(drive_.front(), begin_m_);
}

Navigator::Start Navigator::back_on_drive() {
  std::size_t at = driven_to_ + 1;
  while (at < drive_.size() && road_.lanes[drive_[at]].in_intersection) ++at;
  if (at >= drive_.size()) return at_begin();
  driven_to_ = at;
  plan_from(drive_[at]);
  return start_at(drive_[at], kAfterIntersection_m);
}

void Navigator::plan_from(std::size_t lane) {
  route_ = {lane};
  at_ = 0;
  drive_at_ = 0;
  extend();
}

std::size_t Navigator::lane_after(std::size_t lane) {
  for (std::size_t k = 0; k + 1 < drive_.size(); ++k) {
    const std::size_t at = (drive_at_ + k) % drive_.size();
    if (drive_[at] != lane || at + 1 == drive_.size()) continue;
    drive_at_ = at + 1;
    return drive_[at + 1];
  }
  if (toward_drive_[lane] != kNone) return toward_drive_[lane];
  const std::vector<std::size_t>& successors = lanes_.successors()[lane];
  return successors.empty() ? kNone : successors.front();
}

void Navigator::extend() {
  while (route_.size() <= at_ + kLookahead) {
    const std::size_t next = lane_after(route_.back());
    if (next == kNone) return;
    route_.push_back(next);
  }
}

Navigator::Start Navigator::further_on(const Eigen::Vector2d& from, double by_m) {
  double arc_m = lanes_.centerline(route_[at_]).project({from.x(), from.y(), 0.0}).arc_m + by_m;
  const auto length_m = [this] { return lanes_.centerline(route_[at_]).length(); };
  while (arc_m > length_m() || road_.lanes[route_[at_]].in_intersection) {
    arc_m = std::max(kAfterIntersection_m, arc_m - length_m());
    if (++at_ >= route_.size()) return at_begin();
    extend();
  }
  return start_at(route_[at_], arc_m);
}

bool Navigator::follow(const std::vector<std::size_t>& lanes) {
  const auto among = [](const std::vector<std::size_t>& all, std::size_t lane) {
    return std::ranges::find(all, lane) != all.end();
  };
  for (std::size_t ahead = std::min(kPassed, route_.size() - 1 - at_) + 1; ahead-- > 0;) {
    if (!among(lanes, route_[at_ + ahead])) continue;
    at_ += ahead;
    extend();
    const auto driven =
        std::find(drive_.begin() + static_cast<std::ptrdiff_t>(driven_to_), drive_.end(), route_[at_]);
    if (driven != drive_.end()) driven_to_ = static_cast<std::size_t>(driven - drive_.begin());
    return false;
  }
  // The lane that it took in an intersection is known once it is out of it.
  const auto out =
      std::ranges::find_if(lanes, [this](std::size_t lane) { return !road_.lanes[lane].in_intersection; });
  if (out == lanes.end()) return false;
  const bool turned = road_.lanes[route_[at_]].in_intersection ||
                      (at_ + 1 < route_.size() && road_.lanes[route_[at_ + 1]].in_intersection);
  plan_from(*out);
  return turned;
}

Navigator::Turn Navigator::next_turn(const Point& place) const {
  const auto crosses = [this](std::size_t at) { return road_.lanes[route_[at]].in_intersection; };
  const auto length_m = [this](std::size_t at) { return lanes_.centerline(route_[at]).length(); };
  std::size_t first = at_;
  while (first < route_.size() && !crosses(first)) ++first;
  if (first == route_.size()) return {};
  std::size_t last = first;
  while (first > 0 && crosses(first - 1)) --first;
  while (last + 1 < route_.size() && crosses(last + 1)) ++last;
  double begin_m = -lanes_.centerline(route_[at_]).project(place).arc_m;
  for (std::size_t at = first; at < at_; ++at) begin_m -= length_m(at);
  for (std::size_t at = at_; at < first; ++at) begin_m += length_m(at);
  double across_m = 0.0;
  for (std::size_t at = first; at <= last; ++at) across_m += length_m(at);
  const MeasuredPolyline &in = lanes_.centerline(route_[first]), &out = lanes_.centerline(route_[last]);
  return {turn_between(in.direction(0.0), out.direction(out.length())),
          std::max(0.0, begin_m + 0.5 * across_m)};
}

}  // namespace laneloom::drive
