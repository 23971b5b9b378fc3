#include "mapping/ego_track.hpp"

#include <algorithm>
#include <cmath>

#include "laneloom/polyline.hpp"
#include "mapping/lane_geometry.hpp"
#include "mapping/levels.hpp"

namespace laneloom {
namespace {

constexpr double kMinAlongLane = 0.7;  // cosine between the vehicle's heading and a lane that it drives in
constexpr double kConfidence = 0.95;

/// Whether `to` begins where `from` ends or further on. What lies behind was not driven into: the vehicle is
/// where both meet.
bool leads_ahead(const Lane& from, const Lane& to) {
  return gap_between(from, to).dot(leaving(from)) > -kMaxOverlap_m;
}

void follow(const std::vector<Lane>& lanes, const Eigen::Isometry3d& T_map_body, EgoTrack& track) {
  const auto in_map = [&](ElementId id) { return std::ranges::count(lanes, id, &Lane::id) > 0; };
  std::erase_if(track.steps, [&](const auto& step) { return !in_map(step.first) || !in_map(step.second); });
  const auto drives_in = [&](const Lane& lane) { return ego_sense(lane, T_map_body) > 0.0; };
  const auto before = std::ranges::find(lanes, track.lane, &Lane::id);
  if (before != lanes.end() && drives_in(*before)) return;
  const auto now = std::ranges::find_if(lanes, drives_in);
  if (now == lanes.end()) return;
  if (before != lanes.end() && !are_neighbours(*before, *now) && leads_ahead(*before, *now)) {
    const EgoTrack::Step step(before->id, now->id);
    if (std::ranges::count(track.steps, step) == 0) track.steps.push_back(step);
  }
  track.lane = now->id;
}

}  // namespace

double ego_sense(const Lane& lane, const Eigen::Isometry3d& T_map_body) {
  const MeasuredPolyline line(lane.centerline);
  const Point vehicle = T_map_body.translation();
  const Projection foot = line.project(vehicle);
  if (!foot.inside || foot.distance_m > 0.5 * lane.width_m) return 0.0;
  if (!same_level(foot.foot, vehicle)) return 0.0;
  const Eigen::Vector2d heading = T_map_body.linear().col(0).head<2>();
  const double cosine = line.direction(foot.arc_m).dot(heading);
  if (std::abs(cosine) < kMinAlongLane * heading.norm()) return 0.0;
  return cosine > 0.0 ? 1.0 : -1.0;
}

void link_ego_track(const std::vector<Lane>& lanes, const Eigen::Isometry3d& T_map_body, EgoTrack& track,
                    std::vector<Linkage>& linkages) {
  follow(lanes, T_map_body, track);
  for (const EgoTrack::Step& step : track.steps) {
    const auto known = std::ranges::find_if(
        linkages, [&](const Linkage& linkage) { return EgoTrack::Step(linkage.from, linkage.to) == step; });
    if (known == linkages.end()) {
      const Lane& from = *std::ranges::find(lanes, step.first, &Lane::id);
      const Lane& to = *std::ranges::find(lanes, step.second, &Lane::id);
      const Linkage::Turn turn = turn_between(from, to);
      const bool straight = turn == Linkage::Turn::straight;
      linkages.push_back({.from = from.id,
                          .to = to.id,
                          .kind = Linkage::Kind::ego_track,
                          .turn = turn,
                          .confidence = kConfidence,
                          .path = straight ? path_ahead(from, to) : path_between(from, to)});
    } else if (known->kind == Linkage::Kind::intersection) {
      known->kind = Linkage::Kind::ego_track;
      known->confidence = kConfidence;
    }
  }
  sort(linkages);
}

}  // namespace laneloom
