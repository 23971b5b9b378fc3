#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/dds_values.hpp"
#include "laneloom/config.hpp"
#include "text.hpp"

/// Every key with its unit, its valid range and its meaning. There is one table per struct. Code that reads,
/// checks, or writes a configuration is a visitor of these tables. The structured bindings make a member that
/// is missing here an error of the compiler.
///
/// A visitor has
///   section(key, config, meaning)                another table
///   number(key, value, limits, meaning)          double or int
///   flag(key, value, meaning)                    bool
///   choice(key, value, choices, meaning)         string, one of the choices, which are separated by '|'
///   identifier(key, value, meaning)              string of 1 to 64 letters, digits, '_', '-', '.', '/'
///   path(key, value, meaning)                    any string
namespace laneloom::config {

template <class C, class T>
concept Is = std::same_as<std::remove_const_t<C>, T>;

/// An enum, as a choice among the names of its values, in the order of their numbers.
template <class Enum>
requires std::is_enum_v<std::remove_const_t<Enum>>
void choice(auto& v, const char* key, Enum& value, const char* choices, const char* meaning) {
  std::string text = choice_at(choices, static_cast<std::size_t>(value));
  v.choice(key, text, choices, meaning);
  if constexpr (!std::is_const_v<Enum>) value = static_cast<Enum>(choice_index(choices, text));
}

void visit(auto& v, Is<RangeConfig> auto& c) {
  auto& [forward_min_m, forward_max_m, side_max_m, margin_forward_m, margin_side_m] = c;
  v.number("forward_min_m", forward_min_m, {"m", -200, 200},
           "Rear end of the box: its distance ahead of the body frame's origin.");
  v.number("forward_max_m", forward_max_m, {"m", -200, 200},
           "Front end of the box: its distance ahead of the body frame's origin.");
  v.number("side_max_m", side_max_m, {"m", 1, 200}, "Half of the width of the box.");
  v.number("margin_forward_m", margin_forward_m, {"m", 0, 100},
           "The map also keeps what lies up to this far in front of and behind the box, so that a line has "
           "evidence when it enters the box. The method \"lines\" also publishes it. Ours.");
  v.number("margin_side_m", margin_side_m, {"m", 0, 100},
           "The map also keeps what lies up to this far to the left and right of the box. Ours.");
}

void visit(auto& v, Is<PreprocessConfig> auto& c) {
  auto& [reject_zigzag, min_confidence, zigzag_angle_deg, zigzag_turns, zigzag_min_segment_m] = c;
  v.flag("reject_zigzag", reject_zigzag, "Whether polylines that zigzag are dropped.");
  v.number("min_confidence", min_confidence, {"", 0, 1},
           "A detection with a lower confidence is dropped. The method `lines` keeps it if its network is as "
           "unsure of established lines: if at least this is left when their mean is scaled to 0.6.");
  v.number("zigzag_angle_deg", zigzag_angle_deg, {"deg", 1, 180},
           "A turn of a polyline between consecutive segments counts as a zigzag turn if it is larger than "
           "this. Ours.");
  v.number("zigzag_turns", zigzag_turns, {"", 1, 1000},
           "A polyline with this many zigzag turns is dropped, and a road edge with one more to alternating "
           "sides. Ours.");
  v.number(
      "zigzag_min_segment_m", zigzag_min_segment_m, {"m", 0, 10},
      "Segments of a polyline that are shorter than this are left out when zigzag turns are counted. Ours.");
}

void visit(auto& v, Is<VoxelMapConfig> auto& c) {
  auto& [voxel_size_m, voxel_height_m, sample_step_m, min_detections, remembered_frames] = c;
  v.number("voxel_size_m", voxel_size_m, {"m", 0.05, 2}, "Horizontal edge of a voxel.");
  v.number(
      "voxel_height_m", voxel_height_m, {"m", 0.05, 10},
      "Vertical edge of a voxel. A pitch error of 1 degree shifts a point at 30 m by 0.5 m in height. Ours.");
  v.number("sample_step_m", sample_step_m, {"m", 0.02, 2},
           "Distance between the samples along a detection that hit voxels. Ours.");
  v.number("min_detections", min_detections, {"", 0, 1000},
           "alpha_n: a voxel is reliable when it was detected more often than this.");
  v.number("remembered_frames", remembered_frames, {"frames", 1, 10000},
           "Voxel counts and co-observations forget frames that are older than this. Ours.");
}

void visit(auto& v, Is<ClusteringConfig> auto& c) {
  auto& [min_probability, min_voxels, min_ratio, nearest_instance] = c;
  v.number("min_probability", min_probability, {"", 0, 1},
           "beta_p: a voxel is co-observed with an instance's voxel if their co-observation probability is "
           "higher than this.");
  v.number("min_voxels", min_voxels, {"", 1, 1000},
           "beta_n: a voxel may join an instance if more voxels of the instance than this are co-observed "
           "with it.");
  v.number("min_ratio", min_ratio, {"", 0, 1},
           "beta_r: a voxel may join an instance if a larger share of the instance's voxels than this is "
           "co-observed with it.");
  v.flag("nearest_instance", nearest_instance,
         "Whether a voxel joins the nearest instance that it was ever co-observed with, instead of the three "
         "tests above (paper, Sec. IV-F).");
}

void visit(auto& v, Is<PolylineConfig> auto& c) {
  auto& [straight_ratio, segment_length_m, curve_segment_length_m, min_voxels, min_length_m] = c;
  v.number(
      "straight_ratio", straight_ratio, {"", 0, 1},
      "An instance is divided into groups along its first principal component alone if the second eigenvalue "
      "is less than this share of the first. A more curved instance is divided into quadrants first.");
  v.number("segment_length_m", segment_length_m, {"m", 0.2, 100},
           "Length of a group along the first principal component of a straight instance.");
  v.number("curve_segment_length_m", curve_segment_length_m, {"m", 0.2, 100},
           "Length of a group within a quadrant of a curved instance.");
  v.number("min_voxels", min_voxels, {"", 0, 10000},
           "An instance with fewer voxels gets no polyline. For stoplines half of this counts.");
  v.number("min_length_m", min_length_m, {"m", 0, 100},
           "A polyline shorter than this is left out. For stoplines half of this counts.");
}

// NOLINTNEXTLINE(readability-function-size): a table
void visit(auto& v, Is<FusionConfig> auto& c) {
  auto& [sample_step_m, station_spacing_m, gate_m, gate_angle_deg, min_overlap_m, learn, profile_file,
         stddev_m, stddev_per_m, bias_stddev_m, fade_m, birth_log_odds, extension_log_odds, hit_log_odds,
         miss_log_odds, max_log_odds, min_log_odds, extent_log_odds, publish_log_odds, confirm_log_odds,
         existence_at_publish, existence_at_max, min_birth_length_m, min_length_m, merge_distance_m] = c;
  v.number("sample_step_m", sample_step_m, {"m", 0.1, 2},
           "Distance between the samples along a detection that observe lines.");
  v.number(
      "station_spacing_m", station_spacing_m, {"m", 0.2, 2},
      "Distance between the stations of a line. A line must get fewer than 1024 of them over the range.");
  v.number("gate_m", gate_m, {"m", 0.1, 2}, "A detection observes a line only up to this lateral distance.");
  v.number("gate_angle_deg", gate_angle_deg, {"deg", 1, 90},
           "A detection observes a line only up to this angle between the two.");
  v.number("min_overlap_m", min_overlap_m, {"m", 1, 20},
           "A detection observes a line only if the two run along each other for at least this length.");
  v.flag("learn", learn,
         "Whether the mapper learns how each source errs. If not, what it knows of a source is frozen.");
  v.path("profile_file", profile_file,
         "File with what is known of the networks before anything is learned, as `laneloom learn` writes it. "
         "Empty: nothing is known.");
  v.number("stddev_m", stddev_m, {"m", 0.01, 2},
           "Lateral standard deviation of an observation at the vehicle, before anything is learned.");
  v.number("stddev_per_m", stddev_per_m, {"m/m", 0, 0.2},
           "Growth of the lateral standard deviation of an observation per metre of distance, before "
           "anything is learned.");
  v.number("bias_stddev_m", bias_stddev_m, {"m", 0, 2},
           "Standard deviation of the detector's lasting lateral bias. It does not shrink with more "
           "observations, and is not learned.");
  v.number("fade_m", fade_m, {"m", 0.5, 50},
           "Length over which the lateral step between a line and a detection that extends it fades out.");
  v.number("birth_log_odds", birth_log_odds, {"", -10, 0}, "Log odds of the stations of a new line.");
  v.number("extension_log_odds", extension_log_odds, {"", -10, 10},
           "Log odds of a new station by which a line is extended.");
  v.number("hit_log_odds", hit_log_odds, {"", 0.01, 5},
           "Log odds that a station gains by an observation that is believed by half. Its confidence is 5/6 "
           "of the mean that this network gives to established lines.");
  v.number("miss_log_odds", miss_log_odds, {"", 0, 5},
           "Weight of a miss. A station in view that is not observed loses this, times the negative "
           "logarithm of the rate at which the network misses lines that exist.");
  v.number("max_log_odds", max_log_odds, {"", 0, 20}, "Upper limit of a station's log odds.");
  v.number("min_log_odds", min_log_odds, {"", -20, 0},
           "A station whose log odds fall below this is removed.");
  v.number("extent_log_odds", extent_log_odds, {"", -20, 20},
           "A published line reaches from its first to its last station with log odds of at least this.");
  v.number("publish_log_odds", publish_log_odds, {"", -10, 10},
           "A line is published if its log odds, the mean of its stations with what the beliefs in its "
           "detections tell, are at least this.");
  v.number("confirm_log_odds", confirm_log_odds, {"", -10, 10},
           "A published line is confirmed if its log odds are at least this, and tentative otherwise.");
  v.number("existence_at_publish", existence_at_publish, {"", 0, 1},
           "Existence probability that is published for a line whose log odds equal publish_log_odds.");
  v.number("existence_at_max", existence_at_max, {"", 0, 1},
           "Existence probability that is published for a line with log odds of at least 5, or of "
           "max_log_odds if that is lower.");
  v.number("min_birth_length_m", min_birth_length_m, {"m", 0, 50},
           "A part of a detection that no line explains starts a new line only if it is at least this long.");
  v.number("min_length_m", min_length_m, {"m", 0.1, 50}, "Lines shorter than this are not published.");
  v.number("merge_distance_m", merge_distance_m, {"m", 0, 2},
           "Two lines that are nearer to each other than this, and are not seen together, are merged. Until "
           "this is decided the weaker one of two lines of one type is not published.");
}

void visit(auto& v, Is<StyleConfig> auto& c) {
  auto& [bin_length_m, min_share] = c;
  v.number("bin_length_m", bin_length_m, {"m", 0.2, 100},
           "Length of the pieces of a boundary that get one style each, by the method \"voxels\".");
  v.number("min_share", min_share, {"", 0, 1},
           "Share of the votes that a style needs. With less, the style is unknown.");
}

void visit(auto& v, Is<BoundaryConfig> auto& c) {
  auto& [max_gap_m, max_angle_deg, max_lateral_m] = c;
  v.number("max_gap_m", max_gap_m, {"m", 0, 100},
           "Two ends of markings are joined only up to this distance.");
  v.number(
      "max_angle_deg", max_angle_deg, {"deg", 0, 90},
      "Two ends of markings are joined only up to this angle between their directions, unless detections run "
      "through both or the ends meet.");
  v.number("max_lateral_m", max_lateral_m, {"m", 0, 10},
           "Two ends of markings are joined only if each lies no further than this beside the extension of "
           "the other, unless detections run through both or the ends meet.");
}

void visit(auto& v, Is<SectionConfig> auto& c) {
  auto& [max_angle_deg, max_distance_m] = c;
  v.number("max_angle_deg", max_angle_deg, {"deg", 0, 90},
           "Two boundaries run in a similar direction if their directions differ by less than this.");
  v.number("max_distance_m", max_distance_m, {"m", 0, 100},
           "Two boundaries further apart than this are not in one road section.");
}

void visit(auto& v, Is<LaneConfig> auto& c) {
  auto& [method, min_width_m, max_width_m, max_kerb_width_m, find_side_strips, max_shoulder_width_m,
         publish_side_strips, unmarked_roads, min_divided_width_m, one_sided_lanes, assumed_width_m,
         max_width_variation_m, min_length_m, step_m, id_memory_frames] = c;
  choice(v, "method", method, kLaneMethods,
         "How lanes are found. scored: by log odds of width, styles and surroundings. paper: by the width "
         "alone, as in the paper.");
  v.number("min_width_m", min_width_m, {"m", 0.8, 8.5}, "Narrower strips rather are no lanes.");
  v.number("max_width_m", max_width_m, {"m", 0.8, 8.5},
           "Wider strips between two lines rather are no lanes.");
  v.number("max_kerb_width_m", max_kerb_width_m, {"m", 0.8, 8.5},
           "Wider strips beside a roadedge, where there is room to park, rather are no lanes.");
  v.flag("find_side_strips", find_side_strips,
         "Tell shoulders from lanes, which lie between a roadedge and the solid line of a lane, and cycle "
         "lanes, which are narrow.");
  v.number("max_shoulder_width_m", max_shoulder_width_m, {"m", 0.5, 20}, "A shoulder is narrower than this.");
  v.flag("publish_side_strips", publish_side_strips,
         "Publish shoulders, parking strips and cycle lanes, as lanes with that use. A planner that does not "
         "read the use of a lane would drive in them.");
  v.flag("unmarked_roads", unmarked_roads,
         "Publish a wide road without a line as two lanes with an inferred boundary between them.");
  v.number("min_divided_width_m", min_divided_width_m, {"m", 1, 40},
           "A narrower road without a line rather is one lane.");
  v.flag("one_sided_lanes", one_sided_lanes,
         "Infer a lane beside a line that has nothing on its other side.");
  v.number("assumed_width_m", assumed_width_m, {"m", 0.8, 8.5}, "Width of such an inferred lane.");
  v.number("max_width_variation_m", max_width_variation_m, {"m", 0, 10},
           "Method paper: largest difference between the widest and the narrowest place of a lane.");
  v.number("min_length_m", min_length_m, {"m", 0.5, 100},
           "Shorter lanes are not found anew. What is left of a lane is shown from 2 m on.");
  v.number("step_m", step_m, {"m", 0.1, 10},
           "Distance between the cross-sections of a lane, and between the points of its centerline. A lane "
           "must get fewer than 1024 of them over the range.");
  v.number("id_memory_frames", id_memory_frames, {"frames", 0, 10000},
           "An inferred boundary that comes back within this many frames keeps its id.");
}

void visit(auto& v, Is<LinkageConfig> auto& c) {
  auto& [max_shared_gap_m, max_gap_m, max_lateral_m, max_angle_deg, straight_across, max_crossing_gap_m,
         max_crossing_lateral_m, turns, max_turn_gap_m, min_turn_radius_m] = c;
  v.number("max_shared_gap_m", max_shared_gap_m, {"m", 1, 200},
           "Two lanes along one boundary are linked only up to this gap along it; at a fork, up to 45 m.");
  v.number("max_gap_m", max_gap_m, {"m", 2, 200},
           "Two lanes with aligned centerlines are linked only up to this gap.");
  v.number("max_lateral_m", max_lateral_m, {"m", 0.1, 10},
           "Two lanes with aligned centerlines are linked only up to this lateral offset.");
  v.number(
      "max_angle_deg", max_angle_deg, {"deg", 1, 90},
      "Two lanes are linked by alignment, or straight on across an intersection, only up to this angle.");
  v.flag("straight_across", straight_across,
         "Link lanes straight on across an intersection, where no marking leads.");
  v.number("max_crossing_gap_m", max_crossing_gap_m, {"m", 1, 200},
           "Two lanes are linked straight on across an intersection only up to this gap.");
  v.number("max_crossing_lateral_m", max_crossing_lateral_m, {"m", 0.1, 10},
           "Two lanes are linked straight on across an intersection only up to this lateral offset.");
  v.flag("turns", turns, "Link lanes by left and right turns at intersections.");
  v.number("max_turn_gap_m", max_turn_gap_m, {"m", 1, 200},
           "Two lanes are linked by a left or right turn at an intersection only if the point where their "
           "extensions meet is no further than this from either lane's end.");
  v.number("min_turn_radius_m", min_turn_radius_m, {"m", 0.5, 50},
           "Two lanes are linked by a left or right turn at an intersection only if an arc of this radius "
           "fits between them.");
}

void visit(auto& v, Is<DirectionConfig> auto& c) {
  auto& [driving_side] = c;
  choice(v, "driving_side", driving_side, kDrivingSides, "The side of the road on which traffic keeps.");
}

void visit(auto& v, Is<EvidenceConfig> auto& c) {
  auto& [traffic, sd_map, ego_path] = c;
  v.flag("traffic", traffic,
         "The trails of other vehicles (topic objects). Without them, a map with objects is the same as one "
         "without.");
  v.flag("sd_map", sd_map, "The streets of the SD map (sd_map.file).");
  v.flag("ego_path", ego_path,
         "The vehicle's own drive. Without it, no lane is surer because the vehicle drives in it.");
}

void visit(auto& v, Is<StoplineConfig> auto& c) {
  auto& [max_gap_m, min_angle_deg] = c;
  v.number(
      "max_gap_m", max_gap_m, {"m", 0, 50},
      "A stopline counts as the end of a lane if it lies no further than this before or behind that end.");
  v.number("min_angle_deg", min_angle_deg, {"deg", 0, 90},
           "A stopline holds a lane only if it crosses it at this angle at least.");
}

void visit(auto& v, Is<MapperConfig> auto& c) {
  auto& [method, range, preprocess, voxel_map, clustering, polyline, fusion, style, boundary, section, lane,
         linkage, direction, stopline, evidence, networks] = c;  // networks: of fusion.profile_file
  choice(v, "method", method, kFusionMethods,
         "How detections become markings. \"lines\" follows each line over time (section fusion). \"voxels\" "
         "is the paper's algorithm (sections voxel_map, clustering and polyline).");
  v.section("range", range,
            "The part of the world that is mapped: a box around the vehicle, in the body frame (paper, Sec. "
            "IV-C).");
  v.section("preprocess", preprocess, "The choice of the detections that are believed (paper, Sec. III-A).");
  v.section("voxel_map", voxel_map, "The semantic voxel map (paper, Sec. III-B).");
  v.section("clustering", clustering,
            "Voxels to instances (paper, Sec. III-C-1). A voxel joins an instance that satisfies beta_n or "
            "beta_r.");
  v.section("polyline", polyline,
            "Instances to polylines by principal components (paper, Sec. III-C-2); the values are ours.");
  v.section("fusion", fusion,
            "Fusion along lines: each line is a row of stations, and each station has its own lateral "
            "estimate and evidence (log odds that the line exists there). Ours.");
  v.section("style", style,
            "Marking styles, from matching with the detections (paper, Sec. IV-E); the values are ours.");
  v.section(
      "boundary", boundary,
      "Markings to lane boundaries: ends that fit are joined (paper, Sec. III-D-1). The values are ours.");
  v.section("section", section, "Boundaries to road sections (paper, Sec. III-D-2); the values are ours.");
  v.section("lane", lane, "Boundaries to lanes (paper, Sec. III-D-3); the values are ours.");
  v.section("linkage", linkage, "Lanes to linkages (paper, Sec. III-D-4); the values are ours.");
  v.section("direction", direction, "The direction in which the traffic of a lane runs. Ours.");
  v.section("stopline", stopline, "The lanes whose traffic waits at a stopline. Ours.");
  v.section(
      "evidence", evidence,
      "The kinds of evidence that count beside the detections. A kind that does not count leaves the map "
      "as if its source had never told anything. Ours.");
}

void visit(auto& v, Is<SyncConfig> auto& c) {
  auto& [max_pose_gap_s, max_wait_s, pose_history_s, queue_capacity, pose_queue_capacity] = c;
  v.number("max_pose_gap_s", max_pose_gap_s, {"s", 0.001, 10},
           "The two poses before and after a detection's stamp may be no further apart than this.");
  v.number("max_wait_s", max_wait_s, {"s", 0, 10},
           "A detection frame waits no longer than this after its arrival for the poses around its stamp.");
  v.number("pose_history_s", pose_history_s, {"s", 0.1, 60}, "Poses older than this are forgotten.");
  v.number("queue_capacity", queue_capacity, {"frames", 1, 10000},
           "Most detection frames that are queued between two ticks. When the queue is full, the oldest "
           "frame of the source that has most of them is dropped.");
  v.number(
      "pose_queue_capacity", pose_queue_capacity, {"poses", 1, 100000},
      "Most poses that are queued between two ticks. When the queue is full, the oldest pose is dropped.");
}

void visit(auto& v, Is<GateConfig> auto& c) {
  auto& [max_stamp_step_s, max_speed_mps, max_pose_jump_m, max_turn_rate_degps, max_pose_turn_deg,
         max_coordinate_m, max_frame_detections, max_frame_length_m] = c;
  v.number("max_stamp_step_s", max_stamp_step_s, {"s", 0.01, 60},
           "A stamp that is further than this from the one before is an outlier.");
  v.number("max_speed_mps", max_speed_mps, {"m/s", 1, 200}, "Highest speed of the vehicle that is believed.");
  v.number("max_pose_jump_m", max_pose_jump_m, {"m", 0.01, 1000},
           "A pose is an outlier if it is more than this further from the pose before than max_speed_mps "
           "explains.");
  v.number("max_turn_rate_degps", max_turn_rate_degps, {"deg/s", 1, 720},
           "Quickest turn of the vehicle that is believed.");
  v.number("max_pose_turn_deg", max_pose_turn_deg, {"deg", 0.1, 180},
           "A pose is an outlier if its orientation is more than this further from the pose before than "
           "max_turn_rate_degps explains.");
  v.number("max_coordinate_m", max_coordinate_m, {"m", 1000, 1e7},
           "Messages with larger coordinates are refused.");
  v.number("max_frame_detections", max_frame_detections, {"", 1, 512},
           "Most detections of one frame that are fused. If a frame has more, the least trusted detections "
           "are left out; among equally trusted ones, the farthest.");
  v.number("max_frame_length_m", max_frame_length_m, {"m", 100, 1e5},
           "Greatest length of all markings of one frame together. If a frame has more, the least trusted "
           "detections are left out; among equally trusted ones, the farthest.");
}

void visit(auto& v, Is<ServiceConfig> auto& c) {
  auto& [tick_rate_hz, stale_after_s, degraded_after_s, stale_lag_s, degraded_lag_s, status_period_s,
         log_level, snapshot_file, snapshot_period_s, snapshot_max_age_s] = c;
  // Two ticks are at most two periods apart (src/core/phase_lock.cpp), and two maps no further than their
  // deadline allows (250 ms, src/dds/qos.cpp).
  v.number("tick_rate_hz", tick_rate_hz, {"Hz", 8, 100},
           "How often the map is published. Below 8 Hz the service would miss the deadline that it offers.");
  v.number("stale_after_s", stale_after_s, {"s", 0.05, 60},
           "The map is STALE when no frame was fused for this long.");
  v.number("degraded_after_s", degraded_after_s, {"s", 0.05, 60},
           "The map is DEGRADED when no detections or no poses arrived for this long.");
  v.number("stale_lag_s", stale_lag_s, {"s", 0.1, 60},
           "The map is STALE when, by their stamps, the fused frames lag this far behind the poses.");
  v.number("degraded_lag_s", degraded_lag_s, {"s", 0.1, 60},
           "The map is DEGRADED when, by their stamps, the fused frames lag this far behind the poses.");
  v.number("status_period_s", status_period_s, {"s", 0.1, 60},
           "Time between two status messages while the state does not change.");
  v.choice("log_level", log_level, "debug|info|warn|error|off",
           "Least severe level that is logged on standard error.");
  v.path("snapshot_file", snapshot_file,
         "File that keeps the map, so that a restarted service goes on with it. Empty: the map is not kept.");
  v.number("snapshot_period_s", snapshot_period_s, {"s", 0.1, 60}, "How often the snapshot file is written.");
  v.number("snapshot_max_age_s", snapshot_max_age_s, {"s", 0.1, 60},
           "A snapshot that is older than this is refused at the start.");
}

void visit(auto& v, Is<DdsConfig> auto& c) {
  auto& [domain, vehicle_id, map_frame_id, transport, profile_file, profile_name, security_directory] = c;
  v.number("domain", domain, {"", 0, kLastDomain}, "DDS domain id.");
  v.identifier("vehicle_id", vehicle_id,
               "Name of the DDS partition: vehicles of different ids never mix. Letters, digits, _ - . /");
  v.identifier("map_frame_id", map_frame_id,
               "Name of the frame that the poses must be in and the map is in. Letters, digits, _ - . /");
  v.choice("transport", transport, "udp|udp+shm",
           "\"udp+shm\" adds shared memory, which only works among participants of one user.");
  v.path("profile_file", profile_file,
         "File with Fast DDS XML profiles. The profile decides transports and discovery. Empty: no profile "
         "is used.");
  v.path("profile_name", profile_name, "Name of the participant's profile in profile_file.");
  v.path("security_directory", security_directory,
         "DDS-Security: folder with identity_ca.cert.pem, permissions_ca.cert.pem, cert.pem, key.pem, "
         "governance.p7s and permissions.p7s. Empty: the service is open to everyone.");
}

void visit(auto& v, Is<SdMapConfig> auto& c) {
  auto& [file, origin_latitude_deg, origin_longitude_deg] = c;
  v.path("file", file, "OpenStreetMap extract (XML). Empty: there is no SD map.");
  v.number("origin_latitude_deg", origin_latitude_deg, {"deg", -90, 90},
           "Latitude of the map frame's origin (WGS84). With an SD map, the frame's x points to the east and "
           "y to the north.");
  v.number("origin_longitude_deg", origin_longitude_deg, {"deg", -180, 180},
           "Longitude of the map frame's origin (WGS84).");
}

void visit(auto& v, Is<Ros2Config> auto& c) {
  auto& [enabled, ros_namespace, distro, announce, odometry_topic, objects_topic, road_segments_topic] = c;
  v.flag("enabled", enabled,
         "Whether the service also takes odometry, detections and objects from ROS 2, and publishes the map "
         "there.");
  v.path("namespace", ros_namespace,
         "ROS 2 namespace of this vehicle, such as /car_1. Empty: there is none.");
  v.choice("distro", distro, "humble|jazzy",
           "ROS 2 distribution of the other nodes. Only announce depends on it.");
  v.flag("announce", announce,
         "Whether the service appears as a node (ros_discovery_info). All nodes of the domain must be of the "
         "distribution ros2.distro.");
  v.path("odometry_topic", odometry_topic,
         "Topic of the vehicle's poses in dds.map_frame_id (nav_msgs/Odometry).");
  v.path(
      "objects_topic", objects_topic,
      "Topic of other vehicles, in dds.map_frame_id or base_link (autoware_perception_msgs/TrackedObjects).");
  v.path("road_segments_topic", road_segments_topic,
         "Topic of the map in the vehicle's frame (autoware_mapless_planning_msgs/RoadSegments).");
}

void visit(auto& v, Is<Config> auto& c) {
  auto& [mapper, sd_map, sync, gate, service, dds, ros2] = c;
  v.section("mapper", mapper, "The mapper. \"Ours\" marks what the paper leaves open.");
  v.section("sd_map", sd_map,
            "A standard-definition map: it supplies and confirms linkages across intersections (paper, Sec. "
            "III-D-4).");
  v.section("sync", sync, "Synchronisation of detections with poses.");
  v.section("gate", gate,
            "Limits of the input that is believed. Three outliers in a row that agree with one another are "
            "believed, and reset the map.");
  v.section("service", service, "The service process.");
  v.section("dds", dds, "DDS: how the service meets its participants.");
  v.section("ros2", ros2,
            "The interface for nodes of ROS 2, without a bridge, on a DDS participant of its own. Names "
            "without a leading / are below the namespace.");
}

}  // namespace laneloom::config
