#include "mapping/state.hpp"

#include <utility>
#include <vector>

#include "mapping/geometry/reproducible.hpp"

namespace laneloom {
namespace {

constexpr double kApart_m = 2.0;  // between places of the vehicle's way
constexpr std::size_t kMostPlaces = 30;

void move(const Eigen::Isometry3d& motion, Point& point) { point = motion * point; }

void move(const Eigen::Isometry3d& motion, Way& way) {
  for (WayStation& station : way.stations) {
    const Eigen::Vector2d ahead = motion.linear().topLeftCorner<2, 2>() * station.direction();
    station.heading_rad = geometry::reproducible::atan2(ahead.y(), ahead.x());
    move(motion, station.point);
  }
}

/// Moves what the next map takes from the map before: the pose of a frame that comes late, the centerlines by
/// which lanes are recognised, and the way.
void move(const Eigen::Isometry3d& motion, LocalMap& map) {
  map.T_map_body = motion * map.T_map_body;
  for (Lane& lane : map.lanes)
    for (Point& point : lane.centerline) move(motion, point);
  if (map.way) move(motion, *map.way);
}

}  // namespace

void MapperState::drive_through(const Point& place) {
  if (!driven.empty() && (place - driven.back()).head<2>().norm() < kApart_m) return;
  if (driven.size() == kMostPlaces) driven.erase(driven.begin());
  driven.push_back(place);
}

void MapperState::follow(const Eigen::Isometry3d& motion, const MapperConfig& config) {
  trails = {};
  roadside = {};
  driven_paths = {};
  side.forget_course();
  move(motion, map);
  for (Point& place : driven) move(motion, place);
  turn.forget_place();
  lines::LineMapper* const lines = fusion.lines();
  if (lines == nullptr) {
    fusion = Fusion(config);
    inferred = {};
    lane_tracks = {};
    side_strips = {};
    ego_track = {};
    return;
  }
  lines->move(motion);
  inferred.move(motion);
  lane_tracks.move(motion);
  side_strips.move(motion);
}

}  // namespace laneloom
