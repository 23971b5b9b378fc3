#include "export/weave.hpp"

#include <algorithm>
#include <utility>

#include "export/self_crossings.hpp"
#include "mapping/boundaries/boundary_pairs.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/boundaries/road_sections.hpp"
#include "mapping/geometry/local_range.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/lanes/lane_identity.hpp"
#include "mapping/lanes/lanes.hpp"
#include "mapping/lanes/neighbours.hpp"
#include "mapping/lanes/one_sided_lanes.hpp"
#include "mapping/lanes/shoulders.hpp"
#include "mapping/lanes/unmarked_roads.hpp"
#include "mapping/topology/directions.hpp"
#include "mapping/topology/ego_track.hpp"
#include "mapping/topology/intersections.hpp"
#include "mapping/topology/linkages.hpp"
#include "mapping/topology/stoplines.hpp"

namespace laneloom {
namespace {

/// Between the ends of lines that are one. A local map sees more of such a line yet; a drive is over.
constexpr double kMaxGap_m = 12.0;

using Poses = std::vector<Eigen::Isometry3d>;

/// The whole drive, and what it lets be.
struct Weft {
  std::vector<LaneBoundary> boundaries;
  std::vector<MeasuredPolyline> measured;
  std::vector<Lane> lanes;
  std::vector<KnownLane> known;
};

RangeConfig everything() {
  constexpr double kEverywhere_m = 1e7;
  return {.forward_min_m = -kEverywhere_m, .forward_max_m = kEverywhere_m, .side_max_m = kEverywhere_m};
}

bool is_in_a_lane(const Eigen::Isometry3d& pose, const std::vector<Lane>& lanes, const TakenSpace& taken) {
  return taken.contains(pose.translation()) ||
         std::ranges::any_of(lanes, [&](const Lane& lane) { return ego_sense(lane, pose) != 0.0; });
}

/// Beside one line, there is a lane where it is dashed, and where the vehicle drove.
std::vector<InferredBoundary> lanes_beside_one_line(const SectionGraph& sections, const Weft& weft,
                                                    const Poses& poses, const LaneConfig& config,
                                                    TakenSpace& taken) {
  std::vector<InferredBoundary> inferred;
  const auto add = [&](const Eigen::Isometry3d& pose) {
    std::ranges::move(one_sided_lanes(sections.sections, weft.boundaries, weft.measured,
                                      LocalRange(everything(), pose), config, taken),
                      std::back_inserter(inferred));
  };
  add(poses.front());
  for (const Eigen::Isometry3d& pose : poses)
    if (!is_in_a_lane(pose, weft.lanes, taken)) add(pose);
  return inferred;
}

Weft find_lanes(const DriveAccumulator::Drive& drive, const MapperConfig& config) {
  BoundaryConfig joined = config.boundary;
  joined.max_gap_m = std::max(joined.max_gap_m, kMaxGap_m);
  Weft weft{.boundaries = lane_boundaries(drive.markings, {}, joined)};
  ElementId next_id = drive.markings.size() + 1;
  cut_self_crossings(weft.boundaries, next_id);
  for (const LaneBoundary& boundary : weft.boundaries) weft.measured.emplace_back(boundary.marking.points);
  const Eigen::Isometry3d& last = drive.poses.back();
  const SectionGraph sections = road_sections(config.section, last, weft.boundaries, weft.measured);
  const auto pairs = boundary_pairs(sections, weft.boundaries, weft.measured);
  weft.lanes = generate_lanes(pairs, weft.boundaries, weft.measured, last.translation(), config.lane);
  TakenSpace taken(weft.lanes);
  remove_shoulders(pairs, weft.boundaries, last, config.lane, weft.lanes);
  auto inferred = divide_unmarked(pairs, weft.boundaries, weft.measured, config.lane, taken);
  std::ranges::move(lanes_beside_one_line(sections, weft, drive.poses, config.lane, taken),
                    std::back_inserter(inferred));
  std::vector<KnownInferred> known_inferred;
  identify_inferred(1, 0, config.lane, inferred, known_inferred, next_id);
  add_inferred(std::move(inferred), weft.boundaries, weft.measured, weft.lanes);
  identify_lanes(1, config.lane, weft.lanes, weft.known, next_id);
  find_neighbours(weft.boundaries, weft.lanes);
  return weft;
}

void link_lanes(const DriveAccumulator::Drive& drive, const MapperConfig& config, Weft& weft, LocalMap& map) {
  map.linkages = generate_linkages(weft.lanes, weft.boundaries, weft.measured, config.linkage);
  for (const Eigen::Isometry3d& pose : drive.poses)
    observe_directions(weft.lanes, pose, drive.markings, config.stopline, weft.known);
  find_directions(weft.boundaries, config.direction, weft.known, weft.lanes, map.linkages);
  find_turns(weft.lanes, map.linkages);
  link_across_intersections(weft.boundaries, SdMap{}, config.linkage, weft.lanes, map.linkages);
  EgoTrack track;
  for (const Eigen::Isometry3d& pose : drive.poses) link_ego_track(weft.lanes, pose, track, map.linkages);
}

}  // namespace

LocalMap weave(const DriveAccumulator::Drive& drive, const MapperConfig& config) {
  LocalMap map;
  if (drive.poses.empty()) return map;
  Weft weft = find_lanes(drive, config);
  link_lanes(drive, config, weft, map);
  map.stoplines = tie_stoplines(drive.markings, weft.lanes, config.stopline);
  map.lanes = std::move(weft.lanes);
  for (LaneBoundary& boundary : weft.boundaries) map.boundaries.push_back(std::move(boundary.marking));
  return map;
}

}  // namespace laneloom
