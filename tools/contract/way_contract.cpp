#include <algorithm>
#include <cmath>
#include <numbers>

#include "contract/findings.hpp"
#include "laneloom/lane_graph.hpp"

namespace laneloom::contract {
namespace {

constexpr double kStepTolerance = 0.02;        // share of the step; a chord is shorter than its arc
constexpr double kHeadingTolerance_rad = 0.1;  // between a chord and the headings at its ends
constexpr double kCurvatureTolerance_per_m = 0.05;
constexpr double kMaxBeside_m = 2.5;    // of the begin from the vehicle, in a lane of usual width
constexpr double kMaxOutside_m = 0.75;  // of the vehicle from a wider lane, which it is leaving
constexpr double kLengthTolerance_m = 1e-6;

double turned_rad(double from_rad, double to_rad) {
  return std::remainder(to_rad - from_rad, 2.0 * std::numbers::pi);
}

bool is_finite(const WayStation& s) {
  return s.point.allFinite() && std::ranges::all_of(std::array{s.heading_rad, s.curvature_per_m, s.left_m,
                                                               s.right_m, s.width_m, s.lateral_stddev_m},
                                                    [](double value) { return std::isfinite(value); });
}

/// Whether one station leads to the next. Written so that a NaN fails.
bool leads_to(const WayStation& from, const WayStation& to, double step_m) {
  const Eigen::Vector2d chord = (to.point - from.point).head<2>();
  const double chord_rad = std::atan2(chord.y(), chord.x());
  const double turn_rad = turned_rad(from.heading_rad, to.heading_rad);
  const double by_curvature_rad = 0.5 * (from.curvature_per_m + to.curvature_per_m) * step_m;
  return std::abs(chord.norm() - step_m) <= kStepTolerance * step_m &&
         std::abs(turned_rad(from.heading_rad + 0.5 * turn_rad, chord_rad)) <= kHeadingTolerance_rad &&
         std::abs(turn_rad - by_curvature_rad) <= kCurvatureTolerance_per_m * step_m;
}

void check_stations(const Way& way, Findings& findings) {
  for (std::size_t i = 0; i < way.stations.size(); ++i) {
    const std::string what = "station " + std::to_string(i) + " of the way";
    const WayStation& station = way.stations[i];
    if (!findings.require(is_finite(station), ContractRule::finite_numbers, what + " is not finite")) return;
    findings.require(i == 0 || leads_to(way.stations[i - 1], station, way.step_m), ContractRule::sound_way,
                     what + " does not follow from the one before");
  }
}

void check_way_lanes(const Way& way, const LocalMap& map, Findings& findings) {
  const LaneGraph lanes(map);
  for (const WayLane& lane : way.lanes)
    findings.require(lanes.find(lane.id) != nullptr, ContractRule::known_ids,
                     "the way leads through unknown lane " + std::to_string(lane.id));
  for (const WayStation& station : way.stations)
    findings.require(station.lane == kNoElement ||
                         std::ranges::find(way.lanes, station.lane, &WayLane::id) != way.lanes.end(),
                     ContractRule::sound_way,
                     "a station of the way is in lane " + std::to_string(station.lane) +
                         ", through which it does not lead");
}

}  // namespace

void check_way(const LocalMap& map, Findings& findings) {
  if (!map.way) return;
  const Way& way = *map.way;
  if (!findings.require(way.is_line(), ContractRule::sound_way, "the way has no length")) return;
  check_stations(way, findings);
  check_way_lanes(way, map, findings);
  const WayStation& begin = way.stations.front();
  const double beside_m = (begin.point - map.T_map_body.translation()).head<2>().norm();
  const double most_m = std::max(kMaxBeside_m, std::max(begin.left_m, begin.right_m) + kMaxOutside_m);
  findings.require(beside_m <= most_m, ContractRule::sound_way,
                   "the way begins " + std::to_string(beside_m) + " m from the vehicle");
  findings.require(
      way.known_m >= way.length() - kLengthTolerance_m && way.known_m < way.length() + way.step_m &&
          way.confirmed_m >= 0.0 && way.confirmed_m <= way.known_m,
      ContractRule::sound_way,
      "the way is " + std::to_string(way.length()) + " m long, known for " + std::to_string(way.known_m) +
          " m and confirmed for " + std::to_string(way.confirmed_m) + " m");
}

void check_driven_paths(const LocalMap& map, Findings& findings) {
  for (const DrivenPath& path : map.driven_paths) {
    const std::string what = "driven path " + std::to_string(path.id);
    check_line(path.points, what, findings);
    findings.require(path.probability >= 0.0 && path.probability <= 1.0 &&
                         std::isfinite(path.lateral_stddev_m) && path.lateral_stddev_m >= 0.0,
                     ContractRule::valid_values, what + " has impossible values");
  }
}

}  // namespace laneloom::contract
