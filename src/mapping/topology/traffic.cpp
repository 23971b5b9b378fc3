#include "mapping/topology/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/topology/line_places.hpp"

namespace laneloom::topology {
namespace {

constexpr double kMaxLateral_m = 1.2;  // beside the middle of a lane
constexpr std::size_t kStride = 2;     // steps of a trail that are looked up at once

// An oncoming vehicle passes the own one within these.
constexpr double kAbreast_m = 5.0;                          // ahead or behind
constexpr double kMinPassing_m = 2.0, kMaxPassing_m = 7.0;  // aside
constexpr double kStraight_m = 15.0;                        // that either has driven straight on
constexpr double kCosStraight = 0.985;                      // 10 degrees
constexpr double kMoving_m = 0.1;                           // of the vehicle, since the frame before

constexpr int kBelieved = 2;  // trails that must tell the driving side
constexpr int kMaxTold = 4;   // trails that are remembered, so that a country's border is noticed

/// The lane that a vehicle drives in at a place. `along` is positive if it drives along the lane's points.
struct Driven {
  std::size_t lane = 0;
  double along = 0.0;
};

/// The lane in which a trail goes on from one of its points to another one.
std::optional<Driven> lane_at(const LinePlaces& lanes, const Polyline& trail, std::size_t from,
                              std::size_t to) {
  std::optional<Driven> nearest;
  double nearest_m = kMaxLateral_m;
  lanes.beside(0.5 * (trail[from] + trail[to]), [&](const LinePlace& place, double lateral_m) {
    if (lateral_m > nearest_m) return;
    const double along = place.direction.dot(trails::direction_at(trail, from));
    if (std::abs(along) < kCosInLane) return;
    nearest_m = lateral_m;
    nearest = Driven{place.line, along};
  });
  return nearest;
}

/// Per lane, whether traffic was seen to run along it (1) or against it (-1), by others or by the own drive.
std::vector<double> senses(const std::vector<Lane>& lanes, const std::vector<DrivenStretch>& driven,
                           const lanes::LaneTracks& tracks) {
  std::vector<double> sense(lanes.size(), 0.0);
  for (const DrivenStretch& stretch : driven)
    if (std::abs(stretch.along_m) >= kMinDriven_m) sense[stretch.lane] += std::copysign(1.0, stretch.along_m);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const lanes::LaneTrack* track = tracks.find(lanes[i].id);
    if (track == nullptr || std::abs(track->direction_log_odds) < kOwnDriveKnown) continue;
    sense[i] = track->direction_log_odds;
  }
  return sense;
}

/// The unit direction of the last metres of a trail, if it is long enough and straight; else zero.
Eigen::Vector2d last_course(const trails::Trail& trail) {
  const Point& end = trail.points.back();
  const auto begin = std::find_if(trail.points.rbegin(), trail.points.rend(), [&](const Point& point) {
    return (point - end).head<2>().norm() >= kStraight_m;
  });
  if (begin == trail.points.rend()) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d course = (end - *begin).head<2>().normalized();
  return course.dot(trail.heading) < kCosStraight ? Eigen::Vector2d::Zero() : course;
}

/// Whether an oncoming vehicle passes the own one: 1 on its left, as right-hand traffic does; -1 on its
/// right; 0: it does not.
int passing(const trails::Trail& trail, const Eigen::Isometry3d& T_map_body) {
  if (trail.points.empty()) return 0;
  const Eigen::Vector2d ahead = T_map_body.linear().col(0).head<2>().normalized();
  const Eigen::Vector2d offset = (trail.position - T_map_body.translation()).head<2>();
  const double aside_m = cross(ahead, offset);
  if (std::abs(ahead.dot(offset)) > kAbreast_m || last_course(trail).dot(ahead) > -kCosStraight) return 0;
  if (std::abs(aside_m) < kMinPassing_m || std::abs(aside_m) > kMaxPassing_m) return 0;
  if (!geometry::may_drive_on(trail.position, T_map_body.translation())) return 0;
  return aside_m > 0.0 ? 1 : -1;
}

}  // namespace

std::vector<double> one_way_shares(const SdMap& sd_map, const std::vector<Lane>& lanes) {
  std::vector<double> shares;
  if (sd_map.empty()) return shares;
  shares.reserve(lanes.size());
  for (const Lane& lane : lanes) {
    const MeasuredPolyline line(lane.centerline);
    double sum = 0.0;
    for (const double share : {0.0, 0.5, 1.0}) {
      const double arc_m = share * line.length();
      sum += sd_map.one_way_at(line.at(arc_m).head<2>(), line.direction(arc_m));
    }
    shares.push_back(sum / 3.0);
  }
  return shares;
}

std::vector<DrivenStretch> driven_stretches(const std::vector<trails::Trail>& trails,
                                            const std::vector<Lane>& lanes) {
  std::vector<DrivenStretch> driven;
  if (trails.empty() || lanes.empty()) return driven;
  std::vector<const Polyline*> lines;
  lines.reserve(lanes.size());
  for (const Lane& lane : lanes) lines.push_back(&lane.centerline);
  const LinePlaces places(lines, kMaxLateral_m);
  for (std::size_t i = 0; i < trails.size(); ++i) {
    const Polyline& points = trails[i].points;
    for (std::size_t from = 0, to = 0; from + 1 < points.size(); from = to) {
      const auto way_m = [&](std::size_t end) { return (points[end] - points[from]).head<2>().norm(); };
      to = std::min(from + kStride, points.size() - 1);
      if (way_m(to) > trails::kMaxGap_m) to = from + 1;
      const double step_m = way_m(to);
      if (step_m > trails::kMaxGap_m) continue;
      const auto lane = lane_at(places, points, from, to);
      if (!lane) continue;
      const double along_m = std::copysign(step_m, lane->along);
      const bool goes_on = !driven.empty() && driven.back().trail == i && driven.back().lane == lane->lane &&
                           driven.back().along_m * along_m > 0.0;
      if (!goes_on) driven.push_back({.trail = i, .lane = lane->lane, .first = from});
      driven.back().along_m += along_m;
      driven.back().last = to;
    }
  }
  return driven;
}

void ObservedSide::observe(const std::vector<Lane>& lanes, const RoadTraffic& traffic,
                           const lanes::LaneTracks& tracks, std::vector<trails::Trail>& trails) {
  if (traffic.driven.empty()) return;
  const std::vector<double> sense = senses(lanes, traffic.driven, tracks);
  std::vector<int> told(lanes.size(), 0);  // 1: meets another one as right-hand traffic does; -1: left-hand
  for (const SideBySideLanes& pair : traffic.beside) {
    if (pair.may_part || sense[pair.left] * sense[pair.right] >= 0.0) continue;
    told[pair.left] = told[pair.right] = sense[pair.right] > 0.0 ? 1 : -1;
  }
  for (const DrivenStretch& stretch : traffic.driven) {
    trails::Trail& trail = trails[stretch.trail];
    if (trail.told_side || told[stretch.lane] == 0 || std::abs(stretch.along_m) < kMinDriven_m) continue;
    if (stretch.along_m * sense[stretch.lane] < 0.0) continue;
    trail.told_side = true;
    tell(told[stretch.lane]);
  }
}

bool ObservedSide::drives_straight(const Eigen::Isometry3d& T_map_body) {
  const Eigen::Vector2d heading = T_map_body.linear().col(0).head<2>().normalized();
  const Point place = T_map_body.translation();
  if (heading.dot(straight_heading_) < kCosStraight) {
    straight_from_ = place;
    straight_heading_ = heading;
  }
  return (place - straight_from_).head<2>().norm() >= kStraight_m;
}

void ObservedSide::observe_passing(const Point& before, const Eigen::Isometry3d& T_map_body,
                                   const lanes::LaneLayout& layout, std::vector<trails::Trail>& trails) {
  const bool is_straight = drives_straight(T_map_body);
  if (!is_straight || trails.empty() || (T_map_body.translation() - before).head<2>().norm() < kMoving_m ||
      std::ranges::none_of(layout.lanes,
                           [&](const Lane& lane) { return lanes::ego_sense(lane, T_map_body) != 0.0; }))
    return;
  for (trails::Trail& trail : trails) {
    const int side = trail.told_side ? 0 : passing(trail, T_map_body);
    const Point& other = trail.position;
    if (side == 0 || boundaries::crosses_edge({geometry::lowered(T_map_body.translation(), other), other},
                                              layout.boundaries))
      continue;
    trail.told_side = true;
    tell(side);
  }
}

void ObservedSide::tell(int side) {
  told_ = std::clamp(told_ + side, -kMaxTold, kMaxTold);
  if (std::abs(told_) >= kBelieved)
    believed_ = told_ > 0 ? 1 : -1;
  else if (told_ * believed_ <= 0)
    believed_ = 0;
}

bool ObservedSide::contradicts(DrivingSide driving_side) const {
  if (driving_side == DrivingSide::unknown) return false;
  return believed_ == (driving_side == DrivingSide::right ? -1 : 1);
}

DrivingSide ObservedSide::corrected(DrivingSide driving_side) const {
  if (!contradicts(driving_side)) return driving_side;
  return driving_side == DrivingSide::right ? DrivingSide::left : DrivingSide::right;
}

}  // namespace laneloom::topology
