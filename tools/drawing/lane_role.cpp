#include "drawing/lane_role.hpp"

#include <cmath>

#include "laneloom/lane_graph.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::drawing {
namespace {

constexpr double kMostCrossing = 0.5;  ///< cosine between the vehicle's heading and a lane that crosses

}  // namespace

LaneRole role_of(const Lane& lane, ElementId own, const Eigen::Isometry3d& T_map_body) {
  if (lane.id == own) return LaneRole::own;
  if (!lane.is_drivable()) return LaneRole::unused;
  if (lane.direction == Lane::Direction::unknown || lane.centerline.size() < 2) return LaneRole::unknown;
  const MeasuredPolyline line(lane.centerline);
  const Eigen::Vector2d along = line.direction(line.project(T_map_body.translation()));
  const Point forward = T_map_body.linear() * Point::UnitX();
  const double cosine = along.dot(forward.head<2>().normalized());
  if (std::abs(cosine) < kMostCrossing) return LaneRole::crossing;
  if (lane.direction == Lane::Direction::both) return LaneRole::oncoming;
  return (cosine > 0.0) == (lane.direction == Lane::Direction::along_centerline) ? LaneRole::same_way
                                                                                 : LaneRole::oncoming;
}

ElementId own_lane_of(const LocalMap& map) {
  const auto own = LaneGraph(map).own_lane(map.T_map_body);
  return own ? own->lane.lane->id : kNoElement;
}

const char* title(LaneRole role) {
  switch (role) {
    case LaneRole::own:
      return "own lane";
    case LaneRole::same_way:
      return "same direction";
    case LaneRole::oncoming:
      return "oncoming";
    case LaneRole::crossing:
      return "crossing";
    case LaneRole::unused:
      return "side strip";
    default:
      return "direction unknown";
  }
}

}  // namespace laneloom::drawing
