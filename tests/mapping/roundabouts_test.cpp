// Roundabouts between kerbs, driven with detections that do not err.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "laneloom/mapper.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/shapes.hpp"

namespace laneloom {
namespace {

using test::arc;
using test::straight;

constexpr double kHalfArm_m = 3.5, kCorner_m = 4.0, kEntry_m = 8.0, kArm_m = 30.0;
constexpr double kDegree = std::numbers::pi / 180.0;

void append(Polyline&& more, Polyline& line) { line.insert(line.end(), more.begin(), more.end()); }

/// A roundabout with four arms about the origin, in which traffic runs counter-clockwise, or its mirror
/// image.
struct Roundabout {
  double island_m = 0.0, ring_m = 0.0;
  bool mirrored = false;

  double middle_m() const { return island_m + 0.5 * ring_m; }
  Polyline shown(Polyline line) const {
    for (Point& point : line)
      if (mirrored) point.y() = -point.y();
    return line;
  }
  /// The kerb from one arm round the outside of the ring to the next arm.
  Polyline outer_kerb(int arm) const {
    const double aside_m = kHalfArm_m + kCorner_m, outer_m = island_m + ring_m;
    const double along_m = std::sqrt((outer_m + kCorner_m) * (outer_m + kCorner_m) - aside_m * aside_m);
    const double touch_deg = std::atan2(aside_m, along_m) / kDegree;
    Polyline kerb = straight({along_m + kArm_m, kHalfArm_m, 0}, {along_m, kHalfArm_m, 0}, 60);
    append(arc({along_m, aside_m, 0}, kCorner_m, -90.0, touch_deg - 180.0), kerb);
    append(arc({0, 0, 0}, outer_m, touch_deg, 45.0), kerb);
    for (std::size_t i = kerb.size(); i-- > 0;) kerb.emplace_back(kerb[i].y(), kerb[i].x(), 0.0);
    for (Point& point : kerb) point = Eigen::AngleAxisd(0.5 * std::numbers::pi * arm, Point::UnitZ()) * point;
    return shown(kerb);
  }
  /// All kerbs. The island's closed one begins anywhere.
  std::vector<Polyline> kerbs(std::int64_t frame) const {
    const auto begin_deg = static_cast<double>(37 * frame % 360);
    std::vector<Polyline> kerbs{shown(arc({0, 0, 0}, island_m, begin_deg, begin_deg + 359.0))};
    for (int arm = 0; arm < 4; ++arm) kerbs.push_back(outer_kerb(arm));
    return kerbs;
  }
  double entry_deg() const {
    const double aside_m = 0.5 * kHalfArm_m + kEntry_m, away_m = middle_m() + kEntry_m;
    return std::asin(aside_m / away_m) / kDegree;
  }
  /// From an arm onto the ring, and past three arms.
  Polyline drive() const {
    const double aside_m = 0.5 * kHalfArm_m + kEntry_m;
    const double along_m = aside_m / std::tan(entry_deg() * kDegree);
    Polyline path = straight({along_m + kArm_m, 0.5 * kHalfArm_m, 0}, {along_m, 0.5 * kHalfArm_m, 0}, 60);
    append(arc({along_m, aside_m, 0}, kEntry_m, -90.0, entry_deg() - 180.0), path);
    append(arc({0, 0, 0}, middle_m(), entry_deg(), 315.0), path);
    return shown(path);
  }
};

/// The kerbs as the vehicle sees them from a pose, cut at the box of its view.
DetectionFrame seen_from(const Eigen::Isometry3d& T_map_body, const std::vector<Polyline>& kerbs) {
  DetectionFrame frame;
  const auto add = [&](Polyline& part) {
    if (part.size() > 4) frame.detections.push_back(test::detection(MarkingType::roadedge, part));
    part.clear();
  };
  for (const Polyline& kerb : kerbs) {
    Polyline part;
    for (const Point& point : MeasuredPolyline(kerb).resample(0.5)) {
      const Point place = T_map_body.inverse() * point;
      const bool in_view = place.x() > -5.0 && place.x() < 30.0 && std::abs(place.y()) < 15.0;
      if (in_view)
        part.push_back(place);
      else
        add(part);
    }
    add(part);
  }
  return frame;
}

/// Maps from the vehicle's first metre on the ring on.
std::vector<LocalMap> maps_on_the_ring(const Roundabout& roundabout) {
  MapperConfig config;
  if (roundabout.mirrored) config.direction.driving_side = DrivingSide::left;
  Mapper mapper(config);
  const MeasuredPolyline path(roundabout.drive());
  std::vector<LocalMap> maps;
  double on_ring_m = 0.0;
  for (std::int64_t i = 0; 0.6 * static_cast<double>(i) < path.length() - 1.0; ++i) {
    const double along_m = 0.6 * static_cast<double>(i);
    const Point place = path.at(along_m);
    const Eigen::Vector2d ahead = path.chord(along_m, along_m + 0.5);
    const Eigen::Isometry3d T_map_body = test::at(place.x(), place.y(), std::atan2(ahead.y(), ahead.x()));
    DetectionFrame frame = seen_from(T_map_body, roundabout.kerbs(i));
    frame.stamp_ns = (i + 1) * 100'000'000;
    frame.sequence = static_cast<std::uint64_t>(i + 1);
    LocalMap map = mapper.update(frame, T_map_body);
    if (std::abs(place.norm() - roundabout.middle_m()) < 0.1) on_ring_m += 0.6;
    if (on_ring_m > 1.0) maps.push_back(std::move(map));
  }
  return maps;
}

bool lies_under(const Lane& lane, const Point& place) {
  const Projection left = MeasuredPolyline(lane.left).project(place),
                   right = MeasuredPolyline(lane.right).project(place);
  return left.inside && right.inside && left.lateral_m * right.lateral_m < 0.0;
}

/// The lane under the vehicle. Null: there is none, as where an arm meets the ring.
const Lane* own_lane(const LocalMap& map) {
  const auto found = std::ranges::find_if(
      map.lanes, [&](const Lane& lane) { return lies_under(lane, map.T_map_body.translation()); });
  return found == map.lanes.end() ? nullptr : &*found;
}

/// Whether a lane of the ring is told to run against the traffic.
bool runs_against(const Lane& lane, const Roundabout& roundabout) {
  const MeasuredPolyline center(lane.centerline);
  const double middle_m = 0.5 * center.length();
  const Point place = center.at(middle_m);
  if (std::abs(place.norm() - roundabout.middle_m()) > 0.4 * roundabout.ring_m) return false;
  const bool turns_left = cross(Eigen::Vector2d(place.head<2>()), center.direction(middle_m)) > 0.0;
  return lane.direction != Lane::Direction::unknown &&
         (lane.direction == Lane::Direction::along_centerline) != (turns_left != roundabout.mirrored);
}

double share(const std::vector<LocalMap>& maps, const std::function<bool(const LocalMap&)>& holds) {
  return static_cast<double>(std::ranges::count_if(maps, holds)) / static_cast<double>(maps.size());
}

TEST(Roundabouts, TheRingIsOneLaneInWhichTrafficGoesRound) {
  for (const bool mirrored : {false, true})
    for (const double ring_m : {5.0, 6.0, 7.0})
      for (const double island_m : {10.0, 16.0}) {
        SCOPED_TRACE(testing::Message() << "ring " << ring_m << " m, island " << island_m
                                        << " m, traffic on the " << (mirrored ? "left" : "right"));
        const Roundabout roundabout{island_m, ring_m, mirrored};
        const std::vector<LocalMap> maps = maps_on_the_ring(roundabout);
        const auto has_own = [&](const LocalMap& map) {
          const Lane* own = own_lane(map);
          return own != nullptr && std::abs(own->width_m - ring_m) < 0.5;
        };
        EXPECT_GT(share(maps, has_own), 0.5);
        EXPECT_GT(share(maps, [](const LocalMap& map) { return map.way && map.way->stations.size() > 8; }),
                  0.8);
        for (const LocalMap& map : maps)
          for (const Lane& lane : map.lanes)
            EXPECT_FALSE(runs_against(lane, roundabout))
                << lane.id << " in frame " << map.stamp_ns / 100'000'000;
      }
}

}  // namespace
}  // namespace laneloom
