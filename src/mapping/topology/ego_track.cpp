#include "mapping/topology/ego_track.hpp"

#include <algorithm>

#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::topology {
namespace {

constexpr double kProbability = 0.95;

/// Whether `to` begins where `from` ends or further on. The vehicle did not drive from `from` into a lane
/// that begins behind its end.
bool leads_ahead(const Lane& from, const Lane& to) {
  return lanes::gap_between(from, to).dot(lanes::leaving(from)) > -lanes::kMaxOverlap_m;
}

void follow(const std::vector<Lane>& lanes, const Eigen::Isometry3d& T_map_body, EgoTrack& track) {
  const auto in_map = [&](ElementId id) { return std::ranges::count(lanes, id, &Lane::id) > 0; };
  std::erase_if(track.steps, [&](const auto& step) { return !in_map(step.first) || !in_map(step.second); });
  const auto drives_in = [&](const Lane& lane) { return lanes::ego_sense(lane, T_map_body) > 0.0; };
  const auto before = std::ranges::find(lanes, track.lane, &Lane::id);
  if (before != lanes.end() && drives_in(*before)) return;
  const auto now = std::ranges::find_if(lanes, drives_in);
  if (now == lanes.end()) return;
  if (before != lanes.end() && !lanes::are_neighbours(*before, *now) && leads_ahead(*before, *now)) {
    const EgoTrack::Step step(before->id, now->id);
    if (std::ranges::count(track.steps, step) == 0) track.steps.push_back(step);
  }
  track.lane = now->id;
}

}  // namespace

void link_ego_track(const Eigen::Isometry3d& T_map_body, EgoTrack& track, RoadGraph& road) {
  std::vector<Linkage>& linkages = road.linkages;
  follow(road.lanes, T_map_body, track);
  for (const EgoTrack::Step& step : track.steps) {
    const auto known = std::ranges::find_if(
        linkages, [&](const Linkage& linkage) { return EgoTrack::Step(linkage.from, linkage.to) == step; });
    if (known == linkages.end()) {
      const Lane &from = road.lane(step.first), &to = road.lane(step.second);
      const Linkage::Turn turn = turn_between(from, to);
      const bool straight = turn == Linkage::Turn::straight;
      linkages.push_back({.from = from.id,
                          .to = to.id,
                          .kind = Linkage::Kind::ego_track,
                          .turn = turn,
                          .probability = kProbability,
                          .evidence = Evidence::ego_path,
                          .path = straight ? lanes::path_ahead(from, to) : lanes::path_between(from, to)});
      continue;
    }
    known->evidence |= Evidence::ego_path;
    if (known->kind != Linkage::Kind::intersection) continue;
    known->kind = Linkage::Kind::ego_track;
    known->probability = kProbability;
  }
  road.sort_linkages();
}

}  // namespace laneloom::topology
