#include "mapping/topology/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/geometry/point_grid.hpp"
#include "mapping/topology/side_by_side.hpp"

namespace laneloom::topology {
namespace {

constexpr double kMaxLateral_m = 1.2;       // beside the middle of a lane
constexpr double kCosMaxAngle = 0.8660254;  // 30 degrees
constexpr double kStep_m = 1.0;             // between the places of a lane that are searched
constexpr double kReach_m = 0.6;            // along the lane, from such a place
constexpr double kMaxGap_m = 10.0;          // between two points of a trail within one lane

constexpr double kKnownSense = 2.0;  // log odds from which on the own drive tells the direction of a lane
constexpr int kBelieved = 2;         // trails that must tell the driving side
constexpr int kMaxTold = 4;          // trails that are remembered, so that a country's border is noticed

/// A place in the middle of a lane.
struct LanePlace {
  Point position = Point::Zero();
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< of the lane
  std::size_t lane = 0;
};

geometry::PointGrid<LanePlace> places_of(const std::vector<Lane>& lanes) {
  std::vector<LanePlace> places;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Polyline line = MeasuredPolyline(lanes[i].centerline).resample(kStep_m);
    for (std::size_t k = 0; k + 1 < line.size(); ++k)
      places.push_back({0.5 * (line[k] + line[k + 1]), (line[k + 1] - line[k]).head<2>().normalized(), i});
  }
  return {std::move(places), 2.0 * kMaxLateral_m};
}

/// The lane that a vehicle drives in at a place. `along` is positive if it drives along the lane's points.
struct Driven {
  std::size_t lane = 0;
  double along = 0.0;
};

std::optional<Driven> lane_at(const geometry::PointGrid<LanePlace>& places, const Point& point,
                              const Eigen::Vector2d& direction) {
  std::optional<Driven> nearest;
  double nearest_m = kMaxLateral_m;
  places.around(point, kMaxLateral_m + kStep_m, [&](const LanePlace& place) {
    const Eigen::Vector2d offset = (point - place.position).head<2>();
    const double lateral_m = std::abs(cross(place.direction, offset));
    const double along = place.direction.dot(direction);
    if (lateral_m > nearest_m || std::abs(place.direction.dot(offset)) > kReach_m) return;
    if (std::abs(along) < kCosMaxAngle || !geometry::same_level(point, place.position)) return;
    nearest_m = lateral_m;
    nearest = Driven{place.lane, along};
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
    if (track == nullptr || std::abs(track->direction_log_odds) < kKnownSense) continue;
    sense[i] = track->direction_log_odds;
  }
  return sense;
}

}  // namespace

std::vector<DrivenStretch> driven_stretches(const std::vector<trails::Trail>& trails,
                                            const std::vector<Lane>& lanes) {
  std::vector<DrivenStretch> driven;
  if (trails.empty() || lanes.empty()) return driven;
  const geometry::PointGrid<LanePlace> places = places_of(lanes);
  for (std::size_t i = 0; i < trails.size(); ++i) {
    const Polyline& points = trails[i].points;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const double step_m = (points[k + 1] - points[k]).head<2>().norm();
      if (step_m > kMaxGap_m) continue;
      // A chord over three steps is surer than one step, beside which a tracker's noise is large.
      const Point& from = points[k == 0 ? 0 : k - 1];
      const Point& to = points[std::min(k + 2, points.size() - 1)];
      const auto lane =
          lane_at(places, 0.5 * (points[k] + points[k + 1]), (to - from).head<2>().normalized());
      if (!lane) continue;
      const double along_m = std::copysign(step_m, lane->along);
      const bool goes_on = !driven.empty() && driven.back().trail == i && driven.back().lane == lane->lane &&
                           driven.back().along_m * along_m > 0.0;
      if (goes_on)
        driven.back().along_m += along_m;
      else
        driven.push_back({i, lane->lane, along_m});
    }
  }
  return driven;
}

void ObservedSide::observe(const RoadGraph& road, const std::vector<DrivenStretch>& driven,
                           const lanes::LaneTracks& tracks, std::vector<trails::Trail>& trails) {
  if (driven.empty()) return;
  const std::vector<double> sense = senses(road.lanes, driven, tracks);
  std::vector<int> told(road.lanes.size(),
                        0);  // 1: meets another one as right-hand traffic does; -1: left-hand
  for (const SideBySideLanes& pair : side_by_side(road)) {
    if (pair.may_part || sense[pair.left] * sense[pair.right] >= 0.0) continue;
    told[pair.left] = told[pair.right] = sense[pair.right] > 0.0 ? 1 : -1;
  }
  for (const DrivenStretch& stretch : driven) {
    trails::Trail& trail = trails[stretch.trail];
    if (trail.told_side || told[stretch.lane] == 0 || std::abs(stretch.along_m) < kMinDriven_m) continue;
    if (stretch.along_m * sense[stretch.lane] < 0.0) continue;
    trail.told_side = true;
    right_ = std::clamp(right_ + told[stretch.lane], -kMaxTold, kMaxTold);
  }
}

bool ObservedSide::contradicts(DrivingSide driving_side) const {
  if (driving_side == DrivingSide::unknown) return false;
  return (driving_side == DrivingSide::right ? -right_ : right_) >= kBelieved;
}

}  // namespace laneloom::topology
