#include "evaluation/steadiness.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace laneloom::evaluation {
namespace {

constexpr std::int64_t kWarmUp_ns = 2'000'000'000;
constexpr double kEnd_m = 4.0;  // of the drive
constexpr std::int64_t kShortLife_ns = 500'000'000;
constexpr double kInnerBehind_m = 2.0, kInnerAhead_m = 25.0, kInnerSide_m = 12.0;
constexpr double kLeastInner_m = 3.0;
constexpr double kFarthestReach_m = 30.0;
constexpr double kFarthestFoot_m = 8.0;  // from the places where jumps are measured
constexpr double kTrueLaneWidth_m = 3.6, kTrueWay_m = 10.0, kTrueWayStep_m = 0.5;
constexpr double kRight_m = 0.5, kRightShare = 0.75;

/// The length of the segments whose middles are in the inner range.
double inner_length(const Polyline& line, const Eigen::Isometry3d& T_map_body) {
  const Eigen::Isometry3d T_body_map = T_map_body.inverse();
  double length_m = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point middle = T_body_map * Point(0.5 * (line[i - 1] + line[i]));
    if (middle.x() >= -kInnerBehind_m && middle.x() <= kInnerAhead_m && std::abs(middle.y()) <= kInnerSide_m)
      length_m += (line[i] - line[i - 1]).head<2>().norm();
  }
  return length_m;
}

Eigen::Vector2d chord(const Polyline& line) {
  return line.empty() ? Eigen::Vector2d::Zero() : Eigen::Vector2d((line.back() - line.front()).head<2>());
}

LocalMap as_map(const simulation::Road& truth) {
  LocalMap map;
  for (const simulation::RoadLane& lane : truth.lanes) {
    map.lanes.push_back({.id = lane.id, .centerline = lane.centerline, .width_m = kTrueLaneWidth_m});
    for (const ElementId to : lane.successors) map.linkages.push_back({.from = lane.id, .to = to});
  }
  return map;
}

/// Whether enough of the begin of the true way lies beside the way.
bool is_right(const Polyline& way, const Polyline& true_way) {
  if (way.empty()) return false;
  const MeasuredPolyline measured(way);
  const Polyline places =
      MeasuredPolyline(MeasuredPolyline(true_way).slice({0.0, kTrueWay_m})).resample(kTrueWayStep_m);
  const auto right = std::count_if(places.begin(), places.end(), [&](const Point& place) {
    return measured.project(place).distance_m <= kRight_m;
  });
  return static_cast<double>(right) >= kRightShare * static_cast<double>(places.size());
}

}  // namespace

double Steadiness::per_second(std::size_t events) const {
  return duration_s > 0.0 ? static_cast<double>(events) / duration_s : 0.0;
}

double Steadiness::own_changes_per_km() const {
  return driven_m > 0.0 ? 1000.0 * static_cast<double>(own_changes) / driven_m : 0.0;
}

Steadiness& Steadiness::operator+=(const Steadiness& other) {
  maps += other.maps;
  duration_s += other.duration_s;
  driven_m += other.driven_m;
  lanes += other.lanes;
  blinks += other.blinks;
  ended += other.ended;
  short_lives += other.short_lives;
  turned += other.turned;
  doubted += other.doubted;
  own_wanted += other.own_wanted;
  own_lanes += other.own_lanes;
  own_changes += other.own_changes;
  reach_m.add(other.reach_m);
  gap_m.add(other.gap_m);
  step_m.add(other.step_m);
  kink_deg.add(other.kink_deg);
  for (std::size_t i = 0; i < jump_m.size(); ++i) jump_m[i].add(other.jump_m[i]);
  true_ways += other.true_ways;
  right_ways += other.right_ways;
  return *this;
}

SteadinessSteps::SteadinessSteps(const simulation::Road& truth) : truth_(as_map(truth)) {}

SteadinessSteps::Lanes SteadinessSteps::lanes_of(const LocalMap& map) {
  Lanes lanes;
  for (const Lane& lane : map.lanes) lanes[lane.id] = {lane.centerline, lane.direction};
  return lanes;
}

void SteadinessSteps::add_blinks(const Lanes& lanes, const Eigen::Isometry3d& T_map_body,
                                 Steadiness& added) const {
  for (const auto& [id, lane] : lanes)
    if (!lanes_.contains(id) && inner_length(lane.centerline, T_map_body_) > kLeastInner_m) ++added.blinks;
  for (const auto& [id, lane] : lanes_) {
    if (lanes.contains(id) || inner_length(lane.centerline, T_map_body) <= kLeastInner_m) continue;
    ++added.blinks;
    ++added.ended;
    if (lived_ns_.at(id) < kShortLife_ns) ++added.short_lives;
  }
}

void SteadinessSteps::add_changes(const Lanes& lanes, Steadiness& added) const {
  for (const auto& [id, lane] : lanes) {
    const auto before = lanes_.find(id);
    if (before == lanes_.end()) continue;
    if (before->second.direction != lane.direction) ++added.doubted;
    if (chord(before->second.centerline).dot(chord(lane.centerline)) < 0.0) ++added.turned;
  }
}

void SteadinessSteps::add_jumps(const Polyline& way, const Eigen::Isometry3d& T_map_body,
                                Steadiness& added) const {
  if (way.size() < 2 || way_.size() < 2) return;
  const MeasuredPolyline before(way_), now(way);
  for (std::size_t i = 0; i < kJumpsAhead_m.size(); ++i) {
    const Point place = T_map_body * Point(kJumpsAhead_m[i], 0.0, 0.0);
    const Projection was = before.project(place, kFarthestFoot_m), is = now.project(place, kFarthestFoot_m);
    if (was.inside && is.inside) added.jump_m[i].add(std::abs(is.lateral_m - was.lateral_m));
  }
}

void SteadinessSteps::add_own_change(const LocalMap& map, const Way& way, const Lanes& lanes,
                                     Steadiness& added) {
  if (way.points.empty()) return;
  const ElementId before = std::exchange(own_lane_, way.lane);
  if (before == kNoElement || way.lane == kNoElement || before == way.lane || lanes.contains(before)) return;
  const bool linked = std::any_of(map.linkages.begin(), map.linkages.end(), [&](const Linkage& linkage) {
    return (linkage.from == before && linkage.to == way.lane) ||
           (linkage.from == way.lane && linkage.to == before);
  });
  if (!linked) ++added.own_changes;
}

void SteadinessSteps::add_way(const Way& way, const Eigen::Isometry3d& T_map_body, Steadiness& added) const {
  const Way true_way = truth_ ? way_ahead(*truth_, T_map_body, kTrueWay_m) : Way{};
  const bool wanted = !truth_ || !true_way.points.empty();
  added.own_wanted = wanted ? 1 : 0;
  added.own_lanes = wanted && !way.points.empty() ? 1 : 0;
  if (length(true_way.points) > 0.0) {
    added.true_ways = 1;
    added.right_ways = is_right(way.points, true_way.points) ? 1 : 0;
  }
  for (const Joint& joint : way.joints) {
    added.gap_m.add(joint.gap_m);
    added.step_m.add(joint.step_m);
  }
  if (way.points.empty()) return;
  added.reach_m.add(std::min(kFarthestReach_m, length(way.points)));
  added.kink_deg.add(largest_kink_deg(way.points));
}

std::optional<Steadiness> SteadinessSteps::next(const LocalMap& map) {
  if (!stamp_ns_) stamp_ns_ = map.stamp_ns + kWarmUp_ns;
  const bool first = std::exchange(first_, first_ && map.stamp_ns < *stamp_ns_);
  if (map.stamp_ns < *stamp_ns_ || (!first && map.stamp_ns == *stamp_ns_)) return std::nullopt;
  const std::int64_t passed_ns = map.stamp_ns - *stamp_ns_;
  Lanes lanes = lanes_of(map);
  Way way = way_ahead(map, map.T_map_body);
  Steadiness added{.maps = 1, .duration_s = 1e-9 * static_cast<double>(passed_ns), .lanes = lanes.size()};
  if (!first) {
    added.driven_m = (map.T_map_body.translation() - T_map_body_.translation()).head<2>().norm();
    for (const auto& [id, lane] : lanes_) lived_ns_[id] += passed_ns;
    add_blinks(lanes, map.T_map_body, added);
    add_changes(lanes, added);
    add_jumps(way.points, map.T_map_body, added);
  }
  add_way(way, map.T_map_body, added);
  add_own_change(map, way, lanes, added);
  stamp_ns_ = map.stamp_ns;
  T_map_body_ = map.T_map_body;
  lanes_ = std::move(lanes);
  way_ = std::move(way.points);
  return added;
}

void SteadinessMeter::add(const LocalMap& map) {
  if (auto added = steps_.next(map))
    entries_.push_back({map.T_map_body.translation().head<2>(), *std::move(added)});
}

Steadiness SteadinessMeter::steadiness() const {
  const auto is_before_end = [&](const Entry& entry) {
    return (entry.place - entries_.back().place).norm() >= kEnd_m;
  };
  const auto end = std::find_if(entries_.rbegin(), entries_.rend(), is_before_end).base();
  Steadiness sum;
  for (auto entry = entries_.begin(); entry != end; ++entry) sum += entry->added;
  return sum;
}

}  // namespace laneloom::evaluation
