#pragma once

#include <optional>
#include <vector>

#include "mapping/lanes/way_line.hpp"

namespace laneloom::lanes {

/// Where the way leads, before it is smoothed.
struct Course {
  std::vector<RoutePiece> pieces;
  std::vector<RoutePlace> places;  ///< one or more
  LaneChange change;
};

/// The course from somewhat behind the vehicle to somewhat more than `reach_m` ahead of it, with the wished
/// change of lanes. Empty: the vehicle is in no lane and on no passage.
std::optional<Course> course_of(const LaneGraph& graph, const Eigen::Isometry3d& T_map_body,
                                const RouteWish& wish, double reach_m);

/// The course into a lane that begins ahead, for a vehicle that is in no lane.
Course course_into(const LaneGraph& graph, const DirectedLane& lane, const Eigen::Isometry3d& T_map_body,
                   const RouteWish& wish, double reach_m);

/// The course along the rest of a way that leads through no lane, and on where others drove, or as the street
/// does. Empty: neither leads on.
std::optional<Course> course_beyond(const LaneGraph& graph, const Way& rest, double reach_m);

}  // namespace laneloom::lanes
