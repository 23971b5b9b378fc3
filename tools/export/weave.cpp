#include "export/weave.hpp"

#include <algorithm>
#include <utility>

#include "export/self_crossings.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/boundaries/road_sections.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lanes/continued_edges.hpp"
#include "mapping/lanes/find_lanes.hpp"
#include "mapping/lanes/inferred_memory.hpp"
#include "mapping/lanes/lane_tracks.hpp"
#include "mapping/topology/directions.hpp"
#include "mapping/topology/ego_track.hpp"
#include "mapping/topology/intersections.hpp"
#include "mapping/topology/linkages.hpp"
#include "mapping/topology/stoplines.hpp"
#include "mapping/topology/strip_uses.hpp"

namespace laneloom::exports {
namespace {

/// Greatest gap between the ends of lines that are joined. It is larger than in a local map, which may yet
/// see more of a line; here all drives are over.
constexpr double kMaxGap_m = 12.0;
constexpr double kMaxStep_m = 5.0;  // between poses of one drive

RangeConfig everything() {
  constexpr double kEverywhere_m = 1e7;
  return {.forward_min_m = -kEverywhere_m, .forward_max_m = kEverywhere_m, .side_max_m = kEverywhere_m};
}

boundaries::Boundaries boundaries_of(const SurveyedRoad& surveyed, BoundaryConfig config,
                                     markings::IdSource& ids) {
  config.max_gap_m = std::max(config.max_gap_m, kMaxGap_m);
  return cut_self_crossings(boundaries::lane_boundaries(surveyed.markings, {}, config), ids);
}

void link(const SurveyedRoad& surveyed, const MapperConfig& config, lanes::LaneTracks& tracks,
          topology::RoadGraph& road) {
  for (const Eigen::Isometry3d& pose : surveyed.poses) {
    if (config.evidence.ego_path) topology::observe_drive(road.lanes, pose, tracks);
    topology::observe_stoplines(road.lanes, surveyed.markings, config.stopline, tracks);
  }
  find_directions(config.direction, {side_by_side(road), {}}, tracks, road);
  link_across_intersections(SdMap{}, config.linkage, road);
  if (!config.evidence.ego_path) return;
  topology::EgoTrack track;
  Point before = surveyed.poses.front().translation();
  for (const Eigen::Isometry3d& pose : surveyed.poses) {
    if ((pose.translation() - before).norm() > kMaxStep_m) track.lane = kNoElement;  // another drive
    link_ego_track(pose, track, road);
    before = pose.translation();
  }
}

}  // namespace

LocalMap weave(const SurveyedRoad& surveyed, const MapperConfig& config) {
  LocalMap map;
  if (surveyed.poses.empty()) return map;
  const geometry::Scene scene{.box = geometry::MapBox(everything(), surveyed.poses.back()), .frame = 1};
  markings::IdSource ids(surveyed.markings.size() + 1);
  lanes::InferredMemory inferred;
  lanes::LaneTracks tracks;
  boundaries::Boundaries boundaries = boundaries_of(surveyed, config.boundary, ids);
  boundaries.insert(
      inferred.recognise(lanes::continued_edges(boundaries, scene.box, config.lane), scene, ids));
  boundaries::SectionGraph sections =
      road_sections(std::move(boundaries), scene.T_map_body(), config.section);
  lanes::Driven driven;
  if (config.evidence.ego_path) driven.poses = surveyed.poses;
  lanes::FoundLanes found = lanes::find_lanes(std::move(sections), scene.box, driven, {}, config.lane);
  if (!config.lane.publish_side_strips) found.side_strips.clear();
  lanes::LaneLayout layout = tracks.adopt(inferred.recognise(std::move(found), scene, config.lane, ids), ids);
  topology::RoadGraph road = topology::link_lanes(std::move(layout), config.linkage);
  link(surveyed, config, tracks, road);
  map.stoplines = topology::tie_stoplines(surveyed.markings, road.lanes, config.stopline);
  road.turn_side_strips();
  topology::tell_uses({}, {}, road);
  for (Lane& strip : road.side_strips) {
    strip.id = ids.next();
    road.lanes.push_back(std::move(strip));
  }
  map.lanes = std::move(road.lanes);
  map.linkages = std::move(road.linkages);
  for (boundaries::LaneBoundary& boundary : std::move(road.boundaries).take())
    map.boundaries.push_back(std::move(boundary.marking));
  return map;
}

}  // namespace laneloom::exports
