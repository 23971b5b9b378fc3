#include "mapping/lanes/lane_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mapping/geometry/levels.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kMaxAhead_m = 20.0;
constexpr double kMaxAside_m = 1.75, kMaxSlope = 0.15;  // of the begin, from the line straight ahead
constexpr double kMinAligned = 0.9;                     // cosine between the vehicle's heading and the lane
constexpr double kPerMetreAhead = 0.1;                  // by which a lane fits worse, in metres aside

/// The end of a lane at which it is entered.
End begin_of(const DirectedLane& lane) { return lane.against ? End::back : End::front; }

/// The misfit of the begin of a lane, in metres aside. Infinite: the lane does not begin straight ahead.
double misfit_m(const DirectedLane& lane, const Eigen::Isometry3d& T_map_body) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Point& begin = begin_point(lane);
  const Point vehicle = T_map_body.translation();
  const Eigen::Vector2d heading = T_map_body.linear().col(0).head<2>().normalized();
  const Eigen::Vector2d to_begin = (begin - vehicle).head<2>();
  const double ahead_m = heading.dot(to_begin), aside_m = std::abs(cross(heading, to_begin));
  const bool is_ahead = ahead_m > 0.0 && ahead_m < kMaxAhead_m && geometry::may_drive_on(begin, vehicle);
  if (!is_ahead || aside_m > std::min(kMaxAside_m, 0.5 + kMaxSlope * ahead_m)) return kNone;
  if (begin_direction(lane).dot(heading) < kMinAligned) return kNone;
  return aside_m + kPerMetreAhead * ahead_m;
}

bool is_behind_edge(const Point& begin, const Point& vehicle, const LocalMap& map) {
  return std::ranges::any_of(map.boundaries, [&](const Marking& boundary) {
    return boundary.type == MarkingType::roadedge &&
           intersect({geometry::lowered(vehicle, begin), begin}, boundary.points, geometry::kLevel_m);
  });
}

}  // namespace

const Point& begin_point(const DirectedLane& lane) {
  return end_point(lane.lane->centerline, begin_of(lane));
}

Eigen::Vector2d begin_direction(const DirectedLane& lane) {
  return -end_direction(lane.lane->centerline, begin_of(lane));
}

DirectedLane lane_ahead(const LaneGraph& graph, const Eigen::Isometry3d& T_map_body) {
  DirectedLane best;
  double least_m = std::numeric_limits<double>::infinity();
  for (const Lane& lane : graph.map().lanes)
    for (const bool against : {false, true}) {
      const DirectedLane directed{&lane, against};
      const double misfit = misfit_m(directed, T_map_body);
      if (misfit >= least_m || !lane.is_drivable() || directed.oncoming()) continue;
      if (is_behind_edge(begin_point(directed), T_map_body.translation(), graph.map())) continue;
      best = directed;
      least_m = misfit;
    }
  return best;
}

}  // namespace laneloom::lanes
