#include "mapping/topology/ego_track.hpp"

#include <algorithm>

#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::topology {
namespace {

void follow(const std::vector<Lane>& lanes, const Eigen::Isometry3d& T_map_body, EgoTrack& track) {
  const auto in_map = [&](ElementId id) { return std::ranges::count(lanes, id, &Lane::id) > 0; };
  std::erase_if(track.steps, [&](const auto& step) { return !in_map(step.first) || !in_map(step.second); });
  const auto drives_in = [&](const Lane& lane) { return lanes::ego_sense(lane, T_map_body) > 0.0; };
  const auto before = std::ranges::find(lanes, track.lane, &Lane::id);
  if (before != lanes.end() && drives_in(*before)) return;
  const auto now = std::ranges::find_if(lanes, drives_in);
  if (now == lanes.end()) return;
  if (before != lanes.end() && is_step(*before, *now)) {
    const LaneStep step(before->id, now->id);
    if (std::ranges::count(track.steps, step) == 0) track.steps.push_back(step);
  }
  track.lane = now->id;
}

}  // namespace

void link_ego_track(const Eigen::Isometry3d& T_map_body, EgoTrack& track, RoadGraph& road) {
  follow(road.lanes, T_map_body, track);
  link_driven(track.steps, Driver::ego, road);
}

}  // namespace laneloom::topology
