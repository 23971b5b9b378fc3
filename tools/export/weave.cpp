#include "export/weave.hpp"

#include <algorithm>
#include <utility>

#include "export/self_crossings.hpp"
#include "mapping/boundaries/boundary_pairs.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/boundaries/road_sections.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lanes/continued_edges.hpp"
#include "mapping/lanes/forks.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"
#include "mapping/lanes/inferred_memory.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/lanes/lane_tracks.hpp"
#include "mapping/lanes/lanes.hpp"
#include "mapping/lanes/one_sided_lanes.hpp"
#include "mapping/lanes/shoulders.hpp"
#include "mapping/lanes/unmarked_roads.hpp"
#include "mapping/topology/directions.hpp"
#include "mapping/topology/ego_track.hpp"
#include "mapping/topology/intersections.hpp"
#include "mapping/topology/linkages.hpp"
#include "mapping/topology/stoplines.hpp"

namespace laneloom::exports {
namespace {

/// Greatest gap between the ends of lines that are joined. It is larger than in a local map, which may yet
/// see more of a line; here the drive is over.
constexpr double kMaxGap_m = 12.0;

using Poses = std::vector<Eigen::Isometry3d>;

RangeConfig everything() {
  constexpr double kEverywhere_m = 1e7;
  return {.forward_min_m = -kEverywhere_m, .forward_max_m = kEverywhere_m, .side_max_m = kEverywhere_m};
}

bool is_in_a_lane(const Eigen::Isometry3d& pose, const std::vector<Lane>& lanes,
                  const lanes::TakenSpace& taken) {
  return taken.contains(pose.translation()) ||
         std::ranges::any_of(lanes, [&](const Lane& lane) { return lanes::ego_sense(lane, pose) != 0.0; });
}

/// Lanes beside one line, where the line is dashed or the vehicle drove beside it.
std::vector<lanes::InferredBoundary> lanes_beside_one_line(const boundaries::SectionGraph& sections,
                                                           const std::vector<Lane>& lanes, const Poses& poses,
                                                           const LaneConfig& config,
                                                           lanes::TakenSpace& taken) {
  std::vector<lanes::InferredBoundary> inferred;
  const auto add = [&](const Eigen::Isometry3d& pose) {
    std::ranges::move(one_sided_lanes(sections, geometry::MapBox(everything(), pose), config, taken),
                      std::back_inserter(inferred));
  };
  add(poses.front());
  for (const Eigen::Isometry3d& pose : poses)
    if (!is_in_a_lane(pose, lanes, taken)) add(pose);
  return inferred;
}

boundaries::Boundaries boundaries_of(const DriveAccumulator::Drive& drive, BoundaryConfig config,
                                     markings::IdSource& ids) {
  config.max_gap_m = std::max(config.max_gap_m, kMaxGap_m);
  return cut_self_crossings(boundaries::lane_boundaries(drive.markings, {}, config), ids);
}

lanes::FoundLanes lanes_of(const DriveAccumulator::Drive& drive, boundaries::SectionGraph sections,
                           const LaneConfig& config) {
  const Eigen::Isometry3d& last = drive.poses.back();
  const auto pairs = boundary_pairs(sections);
  const auto strips = lanes::generate_lanes(pairs, sections.boundaries, last.translation(), config);
  lanes::TakenSpace taken(strips);
  auto marked = lanes::without_shoulders(strips, pairs, sections.boundaries, last, config);
  auto forks = lanes::cut_at_forks(sections.boundaries, config, marked);
  auto inferred = divide_unmarked(pairs, sections.boundaries, config, taken);
  std::ranges::move(lanes_beside_one_line(sections, marked, drive.poses, config, taken),
                    std::back_inserter(inferred));
  return {std::move(sections.boundaries), std::move(marked), std::move(inferred), std::move(forks)};
}

void link(const DriveAccumulator::Drive& drive, const MapperConfig& config, lanes::LaneTracks& tracks,
          topology::RoadGraph& road) {
  for (const Eigen::Isometry3d& pose : drive.poses)
    topology::observe_directions(road.lanes, pose, drive.markings, config.stopline, tracks);
  find_directions(config.direction, tracks, road);
  link_across_intersections(SdMap{}, config.linkage, road);
  topology::EgoTrack track;
  for (const Eigen::Isometry3d& pose : drive.poses) link_ego_track(pose, track, road);
}

}  // namespace

LocalMap weave(const DriveAccumulator::Drive& drive, const MapperConfig& config) {
  LocalMap map;
  if (drive.poses.empty()) return map;
  const geometry::Scene scene{.box = geometry::MapBox(everything(), drive.poses.back()), .frame = 1};
  markings::IdSource ids(drive.markings.size() + 1);
  lanes::InferredMemory inferred;
  lanes::LaneTracks tracks;
  boundaries::Boundaries boundaries = boundaries_of(drive, config.boundary, ids);
  boundaries.insert(
      inferred.recognise(lanes::continued_edges(boundaries, scene.box, config.lane), scene, ids));
  boundaries::SectionGraph sections =
      road_sections(std::move(boundaries), scene.T_map_body(), config.section);
  lanes::FoundLanes found = lanes_of(drive, std::move(sections), config.lane);
  lanes::LaneLayout layout = tracks.adopt(inferred.recognise(std::move(found), scene, config.lane, ids), ids);
  topology::RoadGraph road = topology::link_lanes(std::move(layout), config.linkage);
  link(drive, config, tracks, road);
  map.stoplines = topology::tie_stoplines(drive.markings, road.lanes, config.stopline);
  map.lanes = std::move(road.lanes);
  map.linkages = std::move(road.linkages);
  for (boundaries::LaneBoundary& boundary : std::move(road.boundaries).take())
    map.boundaries.push_back(std::move(boundary.marking));
  return map;
}

}  // namespace laneloom::exports
