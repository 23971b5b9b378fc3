#include "laneloom/mapper.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "laneloom/reasons.hpp"
#include "laneloom/way.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/boundaries/road_sections.hpp"
#include "mapping/geometry/scene.hpp"
#include "mapping/lanes/continued_edges.hpp"
#include "mapping/lanes/find_lanes.hpp"
#include "mapping/lineage.hpp"
#include "mapping/markings/preprocess.hpp"
#include "mapping/markings/stage_log.hpp"
#include "mapping/state.hpp"
#include "mapping/state_bytes.hpp"
#include "mapping/topology/directions.hpp"
#include "mapping/topology/driven_linkages.hpp"
#include "mapping/topology/driven_paths.hpp"
#include "mapping/topology/ego_track.hpp"
#include "mapping/topology/intersections.hpp"
#include "mapping/topology/linkages.hpp"
#include "mapping/topology/meeting.hpp"
#include "mapping/topology/side_by_side.hpp"
#include "mapping/topology/stoplines.hpp"
#include "mapping/topology/street_ahead.hpp"
#include "mapping/topology/strip_uses.hpp"
#include "mapping/topology/traffic.hpp"

namespace laneloom {
namespace {

/// The scene of the next map. A frame may come after newer ones of another source: it is fused as it was
/// seen, into the present map. The way of the vehicle leads on to there.
geometry::Scene next_scene(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                           const MapperConfig& config, MapperState& state) {
  const bool newest = frame.stamp_ns >= state.map.stamp_ns;
  const geometry::MapBox box(config.range, newest ? T_map_body : state.map.T_map_body);
  state.drive_through(box.T_map_body().translation());
  geometry::Scene scene{
      .box = box, .stamp_ns = newest ? frame.stamp_ns : state.map.stamp_ns, .frame = ++state.frame};
  if (config.evidence.ego_path) scene.driven = state.driven;
  return scene;
}

/// The parts of a mapper that stay the same for every frame.
struct Setup {
  const MapperConfig& config;
  const SdMap& sd_map;
};

/// The lanes of the map, with the boundaries that they lie between.
lanes::LaneLayout lanes_of(const markings::FusedMarkings& fused, const geometry::Scene& scene,
                           const Setup& setup, const markings::StageLog& log, MapperState& state) {
  const MapperConfig& config = setup.config;
  boundaries::Boundaries boundaries =
      log.done(Stage::lane_boundaries,  // III-D-1
               boundaries::lane_boundaries(fused.markings, fused.joints, config.boundary));
  boundaries.insert(
      state.inferred.recognise(lanes::continued_edges(boundaries, scene.box, config.lane),  // ours
                               scene, state.ids));
  boundaries::SectionGraph sections =
      log.done(Stage::road_sections,
               road_sections(std::move(boundaries), scene.T_map_body(), config.section));  // III-D-2
  lanes::Driven driven{.way = scene.driven};
  if (config.evidence.ego_path) driven.poses = {&scene.T_map_body(), 1};
  lanes::LaneLayout found = state.inferred.recognise(
      lanes::find_lanes(std::move(sections), scene.box, driven,
                        {state.lane_tracks.known_borders(), &setup.sd_map}, config.lane),
      scene, config.lane, state.ids);  // III-D-3
  lanes::LaneLayout layout =
      state.lane_tracks.update(std::move(found), scene, config.lane, state.ids, log.reasons());  // ours
  if (config.lane.publish_side_strips)
    state.side_strips.update(scene, config.lane, state.ids, layout, log.reasons());
  else
    layout.side_strips.clear();
  return log.done(Stage::lanes, std::move(layout));
}

/// The traffic on a road, and the driving side that it keeps to, in place of the configured one.
topology::RoadTraffic observed_traffic(const topology::RoadGraph& road, const geometry::Scene& scene,
                                       const SdMap& sd_map, MapperState& state, DirectionConfig& config) {
  topology::RoadTraffic traffic{.beside = topology::side_by_side(road, scene.driven),
                                .driven = topology::driven_stretches(state.trails.all(), road.lanes),
                                .one_way = topology::one_way_shares(sd_map, road.lanes),
                                .own_way = scene.driven};
  state.side.observe(road.lanes, traffic, state.lane_tracks, state.trails.all());
  state.side.observe_passing(state.map.T_map_body.translation(), scene.T_map_body(), road,
                             state.trails.all());
  traffic.is_side_corrected = state.side.contradicts(config.driving_side);
  config.driving_side = state.side.corrected(config.driving_side);
  return traffic;
}

/// Renames the lanes that have another id now, because they run the other way.
void rename(const std::map<ElementId, ElementId>& renamed, FrameReasons* reasons) {
  if (reasons == nullptr) return;
  for (LaneReason& lane : reasons->lanes)
    if (const auto found = renamed.find(lane.id); found != renamed.end()) lane.id = found->second;
  for (const auto& [former, now] : renamed)
    reasons->lanes.push_back({.id = former, .verdict = LaneReason::Verdict::replaced, .other = now});
}

/// Gives lanes that run the other way now another id.
void name_lanes(FrameReasons* reasons, MapperState& state, topology::RoadGraph& road) {
  const auto renamed = state.lane_tracks.publish(road.lanes, state.ids);
  road.rename(renamed);
  rename(renamed, reasons);
  state.ego_track.forget(renamed);
}

/// The paths of others where the road has no lane, with the ids that they had before.
std::vector<DrivenPath> paths_beside(const topology::RoadGraph& road,
                                     const std::vector<topology::DrivenStretch>& driven,
                                     const geometry::Scene& scene, const LaneConfig& config,
                                     MapperState& state) {
  std::vector<DrivenPath> paths = topology::driven_paths(state.trails.all(), driven, road, scene.box);
  std::vector<const Polyline*> lines;
  lines.reserve(paths.size());
  for (const DrivenPath& path : paths) lines.push_back(&path.points);
  const std::vector<lanes::LineIdentity> known = state.driven_paths.identify(lines, scene, state.ids);
  for (std::size_t i = 0; i < paths.size(); ++i) paths[i].id = known[i].id;
  state.driven_paths.forget(scene, config.id_memory_frames);
  std::ranges::sort(paths, {}, &DrivenPath::id);
  return paths;
}

/// The map of a frame, but for the way. `state` is that of the map before; its membership is set to that of
/// this map.
LocalMap assembled(const geometry::Scene& scene, markings::FusedMarkings fused, topology::RoadGraph road,
                   const StoplineConfig& config, MapperState& state) {
  LocalMap map{.stamp_ns = scene.stamp_ns, .T_map_body = scene.T_map_body()};
  map.stoplines = topology::tie_stoplines(fused.markings, road.lanes, config);
  const Membership before = std::exchange(state.published, membership(road.boundaries, map.stoplines));
  map.lineage = lineage(before, state.published, fused.relatives);
  mark_stoplines(state.map.stoplines, map.lineage);
  mark_stoplines(map.stoplines, map.lineage);
  topology::tell_uses(state.roadside, state.map.lanes, road);
  std::ranges::move(road.side_strips, std::back_inserter(road.lanes));
  std::ranges::sort(road.lanes, {}, &Lane::id);
  std::ranges::move(lane_lineage(state.map.lanes, road.lanes), std::back_inserter(map.lineage));
  for (boundaries::LaneBoundary& boundary : std::move(road.boundaries).take())
    map.boundaries.push_back(std::move(boundary.marking));
  map.markings = std::move(fused.markings);
  map.lanes = std::move(road.lanes);
  map.linkages = std::move(road.linkages);
  return map;
}

/// Makes the own way anew, the way before continued. Where it ends, it goes on as the street of the SD map
/// does, and into the lanes behind. `map` has no way yet.
void lead_on(const SdMap& sd_map, const std::optional<Way>& former, const markings::StageLog& log,
             MapperState& state, LocalMap& map) {
  const Way* const before = former ? &*former : nullptr;
  state.turn.drive_to(map.T_map_body);
  const auto make = [&] {
    return way_ahead(LaneGraph(map), map.T_map_body, state.turn.wish(), before,
                     {.turn_m = state.turn.range()});
  };
  map.way = make();
  if (map.way && topology::go_on_along_street(sd_map, state.driven, *map.way)) map.way = make();
  if (state.turn.is_over(before, map.way ? &*map.way : nullptr)) state.turn = {};
  log.done(Stage::way);
}

/// Takes no more than the pose of a frame that tells next to nothing new.
void see_again(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, const SdMap& sd_map,
               const markings::StageLog& log, MapperState& state) {
  if (FrameReasons* const reasons = log.reasons())
    *reasons = {.stamp_ns = frame.stamp_ns,
                .repeats = true,
                .detections{frame.detections.size(), {.rule = DetectionFate::Rule::repeats}}};
  LocalMap& map = state.map;
  map.lineage.clear();
  if (frame.stamp_ns >= map.stamp_ns) {
    map.stamp_ns = frame.stamp_ns;
    map.T_map_body = T_map_body;
  }
  state.keep_others_around(map.T_map_body.translation());
  lead_on(sd_map, std::exchange(map.way, std::nullopt), log, state, map);
}

}  // namespace

const char* name(Stage stage) {
  static constexpr std::array<const char*, kStageCount> kNames{
      "preprocess",    "voxel_update", "reliable_voxels", "clustering", "local_range",
      "association",   "line_update",  "line_set",        "polylines",  "lane_boundaries",
      "road_sections", "lanes",        "linkages",        "way"};
  return kNames.at(static_cast<std::size_t>(stage));
}

Mapper::Mapper(const MapperConfig& config, SdMap sd_map)
    : config_(config),
      sd_map_(config.evidence.sd_map ? std::move(sd_map) : SdMap()),
      state_(std::make_unique<MapperState>(config)) {
  lines::check_profiles(config_);
}
Mapper::~Mapper() = default;
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

const LocalMap& Mapper::update(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                               StageObserver* observer) {
  const markings::StageLog log(observer);
  MapperState& state = *state_;
  const Eigen::Isometry3d seen_from = follow_poses(frame, T_map_body);
  markings::ObservedFrame observed{
      frame, seen_from,
      log.done(Stage::preprocess,
               markings::preprocess(frame, seen_from, config_.preprocess))};  // paper, III-A
  detections_zigzagging_ = frame.detections.size() - observed.markings.size();
  detections_unsure_ = lines_forgotten_ = 0;
  if (!state.trails.take_growth() && !poses_jumped_ && state.fusion.has_seen(frame, seen_from)) {
    see_again(frame, seen_from, sd_map_, log, state);
    return state.map;
  }
  const geometry::Scene scene = next_scene(frame, seen_from, config_, state);
  state.keep_others_around(scene.T_map_body().translation());
  markings::FusedMarkings fused =
      state.fusion.update(std::move(observed), scene, config_, state.ids, log);  // III-B and III-C
  detections_unsure_ = fused.unsure;
  if (const lines::LineMapper* lines = state.fusion.lines()) lines_forgotten_ = lines->forgotten();
  lanes::LaneLayout layout = lanes_of(fused, scene, {config_, sd_map_}, log, state);
  topology::RoadGraph road =
      topology::link_lanes(std::move(layout), config_.linkage);  // III-D-4; from here on ours
  if (config_.evidence.ego_path) topology::observe_drive(road.lanes, scene.T_map_body(), state.lane_tracks);
  topology::observe_stoplines(road.lanes, fused.markings, config_.stopline, state.lane_tracks);
  DirectionConfig direction = config_.direction;
  const topology::RoadTraffic traffic = observed_traffic(road, scene, sd_map_, state, direction);
  topology::find_directions(direction, traffic, state.lane_tracks, road, log.reasons());
  link_across_intersections(sd_map_, config_.linkage, road);
  link_traffic(state.trails.all(), traffic.driven, road);
  if (config_.evidence.ego_path) link_ego_track(scene.T_map_body(), state.ego_track, road);
  name_lanes(log.reasons(), state, road);
  meet_at_joints(road);
  std::vector<DrivenPath> paths = paths_beside(road, traffic.driven, scene, config_.lane, state);
  LocalMap map =
      log.done(Stage::linkages, assembled(scene, std::move(fused), std::move(road), config_.stopline, state));
  map.driven_paths = std::move(paths);
  lead_on(sd_map_, state.map.way, log, state, map);
  state.map = std::move(map);
  return state.map;
}

/// Moves the map with the poses where they have jumped. Returns the pose of the frame in the map frame of
/// now.
Eigen::Isometry3d Mapper::follow_poses(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
  MapperState& state = *state_;
  poses_jumped_ = false;
  if (frame.stamp_ns < state.map.stamp_ns) return state.pose_jumps.as_of_now(frame.stamp_ns, T_map_body);
  const lines::LineMapper* lines = state.fusion.lines();
  const auto motion =
      state.pose_jumps.find(frame, T_map_body, state.map.markings, lines != nullptr && lines->is_away());
  if (!motion) return T_map_body;
  state.follow(*motion, config_);
  poses_jumped_ = true;
  return T_map_body;
}

void Mapper::add(const TrackedObjects& objects, const Eigen::Isometry3d& T_map_body) {
  if (!config_.evidence.traffic) return;
  const TrackedObjects seen = in_body_frame(objects, T_map_body);
  state_->trails.add(seen, T_map_body);
  if (config_.lane.publish_side_strips) state_->roadside.add(seen, T_map_body);
}

void Mapper::add(const NextTurn& turn, const Eigen::Isometry3d& T_map_body) {
  state_->turn = lanes::WishedTurn(turn, T_map_body.translation());
}

const LocalMap& Mapper::map() const { return state_->map; }

std::vector<std::pair<std::string, double>> Mapper::learned(const std::string& source) const {
  const lines::LineMapper* lines = state_->fusion.lines();
  const lines::Network* network = lines != nullptr ? lines->networks().find(source) : nullptr;
  std::vector<std::pair<std::string, double>> values;
  if (network == nullptr) return values;
  for (const auto& [name, learned] : network->profile()) values.emplace_back(name, learned.value);
  return values;
}

bool Mapper::driving_side_contradicted() const {
  return state_->side.contradicts(config_.direction.driving_side);
}

NetworkProfiles Mapper::profiles() const {
  NetworkProfiles profiles;
  if (const lines::LineMapper* lines = state_->fusion.lines())
    for (const lines::Network& network : lines->networks().all())
      profiles[network.source] = network.profile();
  return profiles;
}

void Mapper::reset() {
  MapperState fresh(config_);
  fresh.ids = state_->ids;
  fresh.frame = state_->frame;  // the networks that are kept know when they were seen last
  if (lines::LineMapper* lines = state_->fusion.lines()) {
    lines->reset();
    fresh.fusion = std::move(state_->fusion);
  }
  *state_ = std::move(fresh);
}

std::string Mapper::save() const { return to_bytes(*state_); }

void Mapper::load(const std::string& bytes) { *state_ = from_bytes(bytes, config_); }

}  // namespace laneloom
