#include "mapping/topology/stoplines.hpp"

#include <cmath>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"

namespace laneloom::topology {
bool crosses_end(const Marking& stopline, const Lane& lane, End lane_end, const StoplineConfig& config) {
  const Point& at = end_point(lane.centerline, lane_end);
  if (!geometry::same_level(at, stopline.points.front())) return false;
  const Eigen::Vector2d end = at.head<2>();
  const Eigen::Vector2d leaving = end_direction(lane.centerline, lane_end);
  const Eigen::Vector2d start = stopline.points.front().head<2>();
  const Eigen::Vector2d along = stopline.points.back().head<2>() - start;
  const double sine = cross(leaving, along) / along.norm();
  if (std::abs(sine) < cos_degrees(90.0 - config.min_angle_deg)) return false;
  // end + gap * leaving = start + share * along
  const double gap_m = cross(start - end, along) / cross(leaving, along);
  const double share = cross(start - end, leaving) / cross(leaving, along);
  return std::abs(gap_m) <= config.max_gap_m && share >= 0.0 && share <= 1.0;
}

std::vector<Stopline> tie_stoplines(const std::vector<Marking>& markings, const std::vector<Lane>& lanes,
                                    const StoplineConfig& config) {
  std::vector<Stopline> stoplines;
  for (const Marking& marking : markings) {
    if (marking.type != MarkingType::stopline) continue;
    Stopline stopline{.marking = marking, .lanes = {}};
    Eigen::Vector2d heading = Eigen::Vector2d::Zero();
    for (const Lane& lane : lanes) {
      for (const End end : {End::back, End::front}) {
        if (end == End::front && lane.direction != Lane::Direction::unknown) continue;
        if (!crosses_end(marking, lane, end, config)) continue;
        stopline.lanes.push_back(lane.id);
        heading += end_direction(lane.centerline, end);
        break;
      }
    }
    if (heading.norm() > 0.5) stopline.heading.head<2>() = heading.normalized();
    stoplines.push_back(std::move(stopline));
  }
  return stoplines;
}

}  // namespace laneloom::topology
