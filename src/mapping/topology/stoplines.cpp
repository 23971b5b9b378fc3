#include "mapping/topology/stoplines.hpp"

#include <cmath>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"

namespace laneloom {
bool crosses_end(const Marking& stopline, const Lane& lane, bool at_back, const StoplineConfig& config) {
  const Point& at = at_back ? lane.centerline.back() : lane.centerline.front();
  if (!same_level(at, stopline.points.front())) return false;
  const Eigen::Vector2d end = at.head<2>();
  const Eigen::Vector2d leaving = end_direction(lane.centerline, at_back);
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
      for (const bool at_back : {true, false}) {
        if (!at_back && lane.direction != Lane::Direction::unknown) continue;
        if (!crosses_end(marking, lane, at_back, config)) continue;
        stopline.lanes.push_back(lane.id);
        heading += end_direction(lane.centerline, at_back);
        break;
      }
    }
    if (heading.norm() > 0.5) stopline.heading.head<2>() = heading.normalized();
    stoplines.push_back(std::move(stopline));
  }
  return stoplines;
}

}  // namespace laneloom
