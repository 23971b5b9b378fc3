#include "laneloom/mapper.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "laneloom/polyline.hpp"
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
#include "mapping/lineage.hpp"
#include "mapping/lines/association.hpp"
#include "mapping/lines/frame_alignment.hpp"
#include "mapping/lines/frame_pitch.hpp"
#include "mapping/lines/joints.hpp"
#include "mapping/lines/line_evidence.hpp"
#include "mapping/lines/line_fusion.hpp"
#include "mapping/lines/line_growth.hpp"
#include "mapping/lines/line_merging.hpp"
#include "mapping/lines/line_publishing.hpp"
#include "mapping/markings/preprocess.hpp"
#include "mapping/state.hpp"
#include "mapping/topology/directions.hpp"
#include "mapping/topology/ego_track.hpp"
#include "mapping/topology/intersections.hpp"
#include "mapping/topology/linkages.hpp"
#include "mapping/topology/stoplines.hpp"
#include "mapping/voxels/clustering.hpp"
#include "mapping/voxels/semantic_voxels.hpp"
#include "mapping/voxels/vectorise.hpp"

namespace laneloom {
namespace {

/// Clears what lies outside of the local range and its margin (paper, Sec. IV-C).
void clear_outside(const LocalRange& range, MapperState& state) {
  for (VoxelId id = 0; id < state.voxels.slots(); ++id) {
    const Voxel& voxel = state.voxels[id];
    if (!voxel.alive || range.keeps(state.voxels.center(voxel))) continue;
    if (voxel.instance != kNoElement) state.instances.remove(id, state.voxels);
    state.co_observation.erase(id);
    state.voxels.erase(id);
  }
  state.instances.erase_empty();
}

/// One frame on its way into the map.
struct Input {
  const DetectionFrame& frame;
  const Eigen::Isometry3d& T_map_body;
  const std::vector<ObservedMarking>& markings;
  const LocalRange& range;
};

/// The paper's instances, by voxels (Sec. III-B and III-C).
template <class Done>
std::vector<Marking> fuse_voxels(const Input& input, const MapperConfig& config, Done done,
                                 MapperState& state) {
  auto& voxels = state.voxels;
  auto& co_observation = state.co_observation;
  auto& instances = state.instances;
  const auto touched = update_voxels(input.markings, input.range, config.voxel_map, voxels, co_observation);
  done(Stage::voxel_update);
  const auto reliable = reliable_voxels(touched.all, voxels, instances, config.voxel_map.min_detections);
  done(Stage::reliable_voxels);
  cluster(reliable, config.clustering, input.frame.stamp_ns, voxels, co_observation, instances,
          state.next_id);
  count_observations(touched.by_detection, voxels, instances);
  done(Stage::clustering);
  clear_outside(input.range, state);
  done(Stage::local_range);
  const Eigen::Vector2d forward = input.T_map_body.linear().col(0).head<2>();
  update_polylines(config.polyline, config.style, voxels, forward, instances);
  auto markings = markings_in_range(input.range, config.polyline.min_length_m, instances, state.next_id);
  done(Stage::polylines);
  return markings;
}

/// Our instances: lines that are followed over time, each station with its own position and evidence.
template <class Done>
std::vector<Marking> fuse_lines(const Input& input, const MapperConfig& config, Done done, MapperState& state,
                                std::vector<Relative>& relatives) {
  const FusionConfig& fusion = config.fusion;
  const Point origin = input.T_map_body.translation();
  auto& lines = state.lines;
  auto detections = sample_detections(input.markings, fusion);
  const auto source = state.networks.number(input.frame.source, state.frame, fusion);
  Network& network = state.networks[source];
  Viewpoint from{.T_map_body = input.T_map_body,
                 .source = static_cast<std::uint32_t>(source),
                 .correlation_m = network.lateral.correlation_m(),
                 .stretch_per_m = estimate_stretch_per_m(detections, input.T_map_body),
                 .pitch_gain = network.lateral.pitch_gain(),
                 .alignment_gain = network.lateral.alignment_gain()};
  unstretch(from.pitch_gain * from.stretch_per_m, input.T_map_body, detections);
  LineMatcher matcher(lines, fusion);
  from.error = align_frame(input.T_map_body, from.alignment_gain, fusion.confirm_log_odds, matcher,
                           detections, state.lasting_error);
  weigh(network.lateral, origin, detections);
  const auto matches = matcher.match(detections);
  mark_explained(matches, detections);
  count_joints(matches, lines, config.boundary.max_gap_m, state.joints);
  done(Stage::association);
  fuse_matches(matches, detections, from, fusion, state.networks, lines);
  const View view{input.T_map_body.inverse(), &input.frame, network.standpoint.news(origin)};
  credit_observed(view, matches, detections, fusion, network.detection, lines);
  discount_unobserved(view, input.range, fusion, network.detection, lines);
  done(Stage::line_update);
  extend_lines(matches, origin, input.range, fusion, detections, lines);
  create_lines(detections, origin, input.frame.stamp_ns, input.range, fusion, network.detection, lines,
               state.next_id);
  relatives = merge_doubles(fusion, lines, state.doubles);
  std::ranges::copy(prune_lines(input.range, fusion, network.detection, lines, state.next_id),
                    std::back_inserter(relatives));
  done(Stage::line_set);
  auto markings = publish_lines(lines, state.doubles, config);
  done(Stage::polylines);
  return markings;
}

}  // namespace

const char* name(Stage stage) {
  static constexpr std::array<const char*, kStageCount> kNames{
      "preprocess",    "voxel_update", "reliable_voxels", "clustering", "local_range",
      "association",   "line_update",  "line_set",        "polylines",  "lane_boundaries",
      "road_sections", "lanes",        "linkages"};
  return kNames.at(static_cast<std::size_t>(stage));
}

Mapper::Mapper(const MapperConfig& config, SdMap sd_map)
    : config_(config), sd_map_(std::move(sd_map)), state_(std::make_unique<MapperState>(config.voxel_map)) {}
Mapper::~Mapper() = default;
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

const LocalMap& Mapper::update(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                               StageObserver* observer) {
  const auto done = [observer](Stage stage) {
    if (observer != nullptr) observer->stage_done(stage);
  };
  MapperState& state = *state_;
  LocalMap& map = state.map;
  if (observer != nullptr) observer->update_begins();
  // A frame may come after newer ones of another source: it is fused as it was seen, into the map of now.
  const bool newest = frame.stamp_ns >= map.stamp_ns;
  const std::int64_t now_ns = newest ? frame.stamp_ns : map.stamp_ns;
  const Eigen::Isometry3d T_map_now = newest ? T_map_body : map.T_map_body;
  const LocalRange range(config_.range, T_map_now);
  ++state.frame;

  const auto markings = preprocess(frame, T_map_body, config_.preprocess);
  done(Stage::preprocess);
  map = LocalMap{.stamp_ns = now_ns, .T_map_body = T_map_now};
  const Input input{frame, T_map_body, markings, range};
  std::vector<Relative> relatives;
  map.markings = config_.method == "voxels" ? fuse_voxels(input, config_, done, state)
                                            : fuse_lines(input, config_, done, state, relatives);
  auto boundaries = lane_boundaries(map.markings, state.joints, config_.boundary);
  std::vector<MeasuredPolyline> measured;
  measured.reserve(boundaries.size());
  for (const LaneBoundary& boundary : boundaries) measured.emplace_back(boundary.marking.points);
  done(Stage::lane_boundaries);
  const SectionGraph sections = road_sections(config_.section, T_map_now, boundaries, measured);
  done(Stage::road_sections);
  const auto pairs = boundary_pairs(sections, boundaries, measured);
  map.lanes = generate_lanes(pairs, boundaries, measured, T_map_now.translation(), config_.lane);
  TakenSpace taken(map.lanes);
  remove_shoulders(pairs, boundaries, T_map_now, config_.lane, map.lanes);
  auto inferred = divide_unmarked(pairs, boundaries, measured, config_.lane, taken);
  std::ranges::move(one_sided_lanes(sections.sections, boundaries, measured, range, config_.lane, taken),
                    std::back_inserter(inferred));
  identify_inferred(state.frame, now_ns, config_.lane, inferred, state.known_inferred, state.next_id);
  add_inferred(std::move(inferred), boundaries, measured, map.lanes);
  identify_lanes(state.frame, config_.lane, map.lanes, state.known_lanes, state.next_id);
  find_neighbours(boundaries, map.lanes);
  done(Stage::lanes);
  map.linkages = generate_linkages(map.lanes, boundaries, measured, config_.linkage);
  observe_directions(map.lanes, T_map_now, map.markings, config_.stopline, state.known_lanes);
  find_directions(boundaries, config_.direction, state.known_lanes, map.lanes, map.linkages);
  find_turns(map.lanes, map.linkages);
  link_across_intersections(boundaries, sd_map_, config_.linkage, map.lanes, map.linkages);
  link_ego_track(map.lanes, T_map_now, state.ego_track, map.linkages);
  map.stoplines = tie_stoplines(map.markings, map.lanes, config_.stopline);
  done(Stage::linkages);

  Membership now = membership(boundaries, map.stoplines);
  map.lineage = lineage(state.published, now, relatives);
  state.published = std::move(now);
  for (LaneBoundary& boundary : boundaries) map.boundaries.push_back(std::move(boundary.marking));
  return map;
}

const LocalMap& Mapper::map() const { return state_->map; }

std::vector<std::pair<std::string, double>> Mapper::learned(const std::string& source) const {
  const Network* network = state_->networks.find(source);
  return network != nullptr ? network->lateral.learned() : std::vector<std::pair<std::string, double>>{};
}

void Mapper::reset() {
  MapperState fresh(config_.voxel_map);
  fresh.next_id = state_->next_id;
  fresh.networks = std::move(state_->networks);
  *state_ = std::move(fresh);
}

const MapperState& Mapper::state() const { return *state_; }

void Mapper::load(MapperState state) { *state_ = std::move(state); }

}  // namespace laneloom
