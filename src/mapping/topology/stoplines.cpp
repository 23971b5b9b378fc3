#include "mapping/topology/stoplines.hpp"

#include <cmath>
#include <optional>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"

namespace laneloom::topology {
namespace {

/// The distance ahead at which a ray meets a stopline, negative if that lies behind. Empty: the ray passes
/// beside it, on another level, or at too small an angle. `ahead` is a unit vector.
std::optional<double> distance_ahead(const Marking& stopline, const Point& from, const Eigen::Vector2d& ahead,
                                     const StoplineConfig& config) {
  if (!geometry::same_level(from, stopline.points.front())) return std::nullopt;
  const Eigen::Vector2d start = stopline.points.front().head<2>();
  const Eigen::Vector2d along = stopline.points.back().head<2>() - start;
  const double sine = cross(ahead, along) / along.norm();
  if (std::abs(sine) < cos_degrees(90.0 - config.min_angle_deg)) return std::nullopt;
  // from + distance * ahead = start + share * along
  const Eigen::Vector2d away = start - from.head<2>();
  const double share = cross(away, ahead) / cross(ahead, along);
  if (share < 0.0 || share > 1.0) return std::nullopt;
  return cross(away, along) / cross(ahead, along);
}

/// The direction of a lane's centerline where a stopline crosses it, at least `from_m` behind its begin.
/// Zero: it does not.
Eigen::Vector2d crossed(const Marking& stopline, const Polyline& centerline, double from_m,
                        const StoplineConfig& config) {
  double arc_m = 0.0;
  for (std::size_t i = 0; i + 1 < centerline.size(); ++i) {
    const Eigen::Vector2d step = (centerline[i + 1] - centerline[i]).head<2>();
    const double step_m = step.norm();
    const auto ahead_m = distance_ahead(stopline, centerline[i], step / step_m, config);
    if (ahead_m && *ahead_m >= 0.0 && *ahead_m <= step_m && arc_m + *ahead_m >= from_m) return step / step_m;
    arc_m += step_m;
  }
  return Eigen::Vector2d::Zero();
}

/// Adds a lane to a stopline at which its traffic waits. Returns the direction of that traffic; zero:
/// unknown.
Eigen::Vector2d hold(const Lane& lane, const StoplineConfig& config, Stopline& stopline) {
  const bool is_known = lane.direction != Lane::Direction::unknown;
  for (const End end : {End::back, End::front}) {
    if (end == End::front && is_known) continue;
    if (!crosses_end(stopline.marking, lane, end, config)) continue;
    stopline.lanes.push_back(lane.id);
    return end_direction(lane.centerline, end);
  }
  // Traffic that comes from a stopline at the begin of a lane has passed it.
  Eigen::Vector2d along =
      crossed(stopline.marking, lane.centerline, is_known ? config.max_gap_m : 0.0, config);
  if (along.isZero()) return along;
  stopline.lanes.push_back(lane.id);
  return is_known ? along : Eigen::Vector2d::Zero();
}

}  // namespace

bool crosses_end(const Marking& stopline, const Lane& lane, End lane_end, const StoplineConfig& config) {
  const auto gap_m = distance_ahead(stopline, end_point(lane.centerline, lane_end),
                                    end_direction(lane.centerline, lane_end), config);
  return gap_m && std::abs(*gap_m) <= config.max_gap_m;
}

std::vector<Stopline> tie_stoplines(const std::vector<Marking>& markings, const std::vector<Lane>& lanes,
                                    const StoplineConfig& config) {
  std::vector<Stopline> stoplines;
  for (const Marking& marking : markings) {
    if (marking.type != MarkingType::stopline) continue;
    Stopline stopline{.marking = marking, .lanes = {}};
    Eigen::Vector2d heading = Eigen::Vector2d::Zero();
    for (const Lane& lane : lanes) heading += hold(lane, config, stopline);
    if (heading.norm() > 0.5) stopline.heading.head<2>() = heading.normalized();
    stoplines.push_back(std::move(stopline));
  }
  return stoplines;
}

}  // namespace laneloom::topology
