#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mapping/lanes/way_passages.hpp"

/// The lanes and passages that a way leads through.
namespace laneloom::lanes {

/// A stretch of a route: a lane, or a passage with a path.
struct RoutePiece {
  DirectedLane lane;  ///< no lane: a passage
  Linkage::Turn entry = Linkage::Turn::unknown;
  double lateral_stddev_m = kNotKnown_m;  ///< of a passage, at its begin
  double stddev_per_m = 0.0;              ///< by which that grows along the passage
};

/// A point of a route.
struct RoutePoint {
  Point point = Point::Zero();  ///< map frame
  std::size_t piece = 0;        ///< index of the piece
  double arc_m = 0.0;           ///< along the piece's lane, as it is walked
  double along_m = 0.0;         ///< along the route
};

/// A place where the map's lines do not join.
struct RouteJoint {
  double along_m = 0.0;  ///< along the route
  double step_m = 0.0;   ///< from the one line to the other, across
};

struct Route {
  std::vector<RoutePiece> pieces;
  std::vector<RoutePoint> points;  ///< one or more
  std::vector<RouteJoint> joints;
};

/// The greatest distance of a vehicle from a line that it drives on without a lane, and the least cosine
/// between its heading and that line.
inline constexpr double kMaxBesidePath_m = 1.75, kMinAlongPath = 0.7;

/// The place of the vehicle: in a lane, or else on a passage. Empty: in neither.
std::optional<RouteStart> start_of(const LaneGraph& graph, const Eigen::Isometry3d& T_map_body,
                                   const RouteWish& wish);

/// The route from `behind_m` behind a place to `ahead_m` ahead of it, or somewhat more; less where lanes end.
Route route_through(const LaneGraph& graph, const RouteStart& start, const RouteWish& wish, double behind_m,
                    double ahead_m);

/// The route straight ahead and into a lane that begins there, for a vehicle that is in no lane. `range` is
/// from behind the vehicle (negative) to ahead of it.
Route route_into(const LaneGraph& graph, const DirectedLane& lane, const Eigen::Isometry3d& T_map_body,
                 const RouteWish& wish, const Stretch& range);

/// The rest of a way that leads through no lane, and from its end on what others drove, or as the street
/// does. Empty: neither leads on.
std::optional<Route> route_beyond(const LaneGraph& graph, const Way& rest, double ahead_m);

}  // namespace laneloom::lanes
