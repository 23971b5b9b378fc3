#include "simulation/ghosts.hpp"

#include <algorithm>
#include <cmath>

#include "base/degree.hpp"
#include "laneloom/polyline.hpp"
#include "simulation/line_noise.hpp"

namespace laneloom::simulation {
namespace {

// A line anywhere ahead of the vehicle: roughly along its heading, or across it for a stopline.
Polyline anywhere(MarkingType type, const SensorView& view, Random& random) {
  const Point begin(random.uniform(view.forward_min_m, 0.6 * view.forward_max_m),
                    random.uniform(-0.6, 0.6) * view.side_max_m, 0.0);
  const bool across = type == MarkingType::stopline;
  const double heading_rad = 10.0 * kDegree * random.normal() + (across ? 90.0 * kDegree : 0.0);
  const double length_m = across ? random.uniform(2.5, 7.0) : random.uniform(5.0, 20.0);
  return {begin, begin + length_m * Point(std::cos(heading_rad), std::sin(heading_rad), 0.0)};
}

// A line beside a part of a marking, like a kerb's shadow or a repaired crack.
Polyline beside(const Polyline& marking, Random& random) {
  const MeasuredPolyline measured(marking);
  const double length_m = random.uniform(0.3, 1.0) * measured.length();
  const double from_m = random.uniform() * (measured.length() - length_m);
  const double left_m = random.uniform(0.7, 2.6) * (random.chance(0.5) ? 1.0 : -1.0);
  Polyline line = measured.slice({from_m, from_m + length_m});
  shift_left(line, left_m);
  return line;
}

}  // namespace

Ghosts::Ghosts(const Road& road) {
  for (const RoadLane& lane : road.lanes) {
    if (!lane.in_intersection) continue;
    crossings_.emplace_back(lane.left);
    crossings_.emplace_back(lane.right);
  }
}

void Ghosts::step(const VehiclePose& pose, const std::vector<Polyline>& in_view, double dt_s,
                  const NoiseProfile& noise, const SensorView& view, Random& random) {
  std::erase_if(ghosts_, [&](const Ghost& ghost) { return random.chance(dt_s / ghost.dwell_s); });
  for (Ghost& ghost : ghosts_) ghost.confidence.step(dt_s, noise.confidence_memory_s, random);
  if (random.chance(noise.intersection_ghost_rate_hz * dt_s))
    appear_at_intersection(pose, noise, view, random);
  const Eigen::Isometry3d T_map_body = transform(pose);
  for (const MarkingType type : kMarkingTypes) {
    if (!random.chance(noise.ghost_rate_hz.at(index(type)) * dt_s) || !view.detects(type)) continue;
    const bool along =
        type != MarkingType::stopline && !in_view.empty() && random.chance(noise.ghost_beside_share);
    Polyline points =
        along ? beside(in_view[random.below(in_view.size())], random) : anywhere(type, view, random);
    for (Point& point : points) point = T_map_body * point;
    appear(type, std::move(points), noise, random);
  }
}

void Ghosts::appear_at_intersection(const VehiclePose& pose, const NoiseProfile& noise,
                                    const SensorView& view, Random& random) {
  std::vector<const ViewedLine*> in_view;
  for (const ViewedLine& crossing : crossings_) {
    if (crossing.may_be_near(pose.position, view.side_max_m)) in_view.push_back(&crossing);
  }
  const MarkingType type = random.chance(0.4) ? MarkingType::roadedge : MarkingType::laneline;
  // At intersections, networks continue lines where there are none.
  if (!in_view.empty() && view.detects(type))
    appear(type, in_view[random.below(in_view.size())]->line.points(), noise, random);
}

void Ghosts::appear(MarkingType type, Polyline points_map, const NoiseProfile& noise, Random& random) {
  const bool dashed = type == MarkingType::laneline && random.chance(0.5);
  const bool lasting = random.chance(noise.ghost_lasting_share);
  ghosts_.push_back({.points_map = std::move(points_map),
                     .type = type,
                     .style = dashed ? MarkingStyle::dashed : MarkingStyle::solid,
                     .dwell_s = lasting ? noise.ghost_lasting_dwell_s : noise.ghost_dwell_s,
                     .confidence = Wander(random)});
}

std::vector<Detection> Ghosts::detections(const VehiclePose& pose, const NoiseProfile& noise,
                                          const SensorView& view, Random& random) const {
  const Eigen::Isometry3d T_body_map = transform(pose).inverse();
  std::vector<Detection> seen;
  for (const Ghost& ghost : ghosts_) {
    for (VisiblePiece& piece : visible_pieces(ViewedLine(ghost.points_map), view, T_body_map)) {
      shift_left(piece.points, noise.ghost_jitter_m * random.normal());
      seen.push_back(
          {.type = ghost.type,
           .style = ghost.style,
           .confidence = noise.ghost_confidence + confidence_error(noise, ghost.confidence, random),
           .points = std::move(piece.points),
           .stddev_m = {}});
    }
  }
  return seen;
}

}  // namespace laneloom::simulation
