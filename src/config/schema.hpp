#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

#include "laneloom/config.hpp"
#include "text.hpp"

/// Every key with its unit and its valid range. One table per struct; whatever reads, checks, or writes a
/// configuration is a visitor of these tables. The structured bindings make a member that is missing here an
/// error of the compiler.
///
/// A visitor has
///   section(key, config)                     another table
///   number(key, value, unit, min, max)       double or int
///   flag(key, value)                         bool
///   choice(key, value, choices)              string, one of the choices, which are separated by '|'
///   identifier(key, value)                   string of 1 to 64 letters, digits, '_', '-', '.', '/'
///   path(key, value)                         any string
namespace laneloom::config {

template <class C, class T>
concept Is = std::same_as<std::remove_const_t<C>, T>;

/// An enum, as a choice among the names of its values, in the order of their numbers.
template <class Enum>
requires std::is_enum_v<std::remove_const_t<Enum>>
void choice(auto& v, const char* key, Enum& value, const char* choices) {
  std::string text = choice_at(choices, static_cast<std::size_t>(value));
  v.choice(key, text, choices);
  if constexpr (!std::is_const_v<Enum>) value = static_cast<Enum>(choice_index(choices, text));
}

void visit(auto& v, Is<RangeConfig> auto& c) {
  auto& [forward_min_m, forward_max_m, side_max_m, margin_forward_m, margin_side_m] = c;
  v.number("forward_min_m", forward_min_m, "m", -200, 200);
  v.number("forward_max_m", forward_max_m, "m", -200, 200);
  v.number("side_max_m", side_max_m, "m", 1, 200);
  v.number("margin_forward_m", margin_forward_m, "m", 0, 100);
  v.number("margin_side_m", margin_side_m, "m", 0, 100);
}

void visit(auto& v, Is<PreprocessConfig> auto& c) {
  auto& [reject_zigzag, min_confidence, zigzag_angle_deg, zigzag_turns, zigzag_min_segment_m] = c;
  v.flag("reject_zigzag", reject_zigzag);
  v.number("min_confidence", min_confidence, "", 0, 1);
  v.number("zigzag_angle_deg", zigzag_angle_deg, "deg", 1, 180);
  v.number("zigzag_turns", zigzag_turns, "", 1, 1000);
  v.number("zigzag_min_segment_m", zigzag_min_segment_m, "m", 0, 10);
}

void visit(auto& v, Is<VoxelMapConfig> auto& c) {
  auto& [voxel_size_m, voxel_height_m, sample_step_m, min_detections, remembered_frames] = c;
  v.number("voxel_size_m", voxel_size_m, "m", 0.05, 2);
  v.number("voxel_height_m", voxel_height_m, "m", 0.05, 10);
  v.number("sample_step_m", sample_step_m, "m", 0.02, 2);
  v.number("min_detections", min_detections, "", 0, 1000);
  v.number("remembered_frames", remembered_frames, "frames", 1, 10000);
}

void visit(auto& v, Is<ClusteringConfig> auto& c) {
  auto& [min_probability, min_voxels, min_ratio, nearest_instance] = c;
  v.number("min_probability", min_probability, "", 0, 1);
  v.number("min_voxels", min_voxels, "", 1, 1000);
  v.number("min_ratio", min_ratio, "", 0, 1);
  v.flag("nearest_instance", nearest_instance);
}

void visit(auto& v, Is<PolylineConfig> auto& c) {
  auto& [straight_ratio, segment_length_m, curve_segment_length_m, min_voxels, min_length_m] = c;
  v.number("straight_ratio", straight_ratio, "", 0, 1);
  v.number("segment_length_m", segment_length_m, "m", 0.2, 100);
  v.number("curve_segment_length_m", curve_segment_length_m, "m", 0.2, 100);
  v.number("min_voxels", min_voxels, "", 0, 10000);
  v.number("min_length_m", min_length_m, "m", 0, 100);
}

void visit(auto& v, Is<FusionConfig> auto& c) {
  auto& [sample_step_m, station_spacing_m, gate_m, gate_angle_deg, min_overlap_m, learn, stddev_m,
         stddev_per_m, bias_stddev_m, fade_m, birth_log_odds, extension_log_odds, hit_log_odds, miss_log_odds,
         max_log_odds, min_log_odds, extent_log_odds, publish_log_odds, confirm_log_odds,
         existence_at_publish, existence_at_max, min_birth_length_m, min_length_m, merge_distance_m] = c;
  v.number("sample_step_m", sample_step_m, "m", 0.1, 2);
  v.number("station_spacing_m", station_spacing_m, "m", 0.2, 2);
  v.number("gate_m", gate_m, "m", 0.1, 2);
  v.number("gate_angle_deg", gate_angle_deg, "deg", 1, 90);
  v.number("min_overlap_m", min_overlap_m, "m", 1, 20);
  v.flag("learn", learn);
  v.number("stddev_m", stddev_m, "m", 0.01, 2);
  v.number("stddev_per_m", stddev_per_m, "m/m", 0, 0.2);
  v.number("bias_stddev_m", bias_stddev_m, "m", 0, 2);
  v.number("fade_m", fade_m, "m", 0.5, 50);
  v.number("birth_log_odds", birth_log_odds, "", -10, 0);
  v.number("extension_log_odds", extension_log_odds, "", -10, 10);
  v.number("hit_log_odds", hit_log_odds, "", 0.01, 5);
  v.number("miss_log_odds", miss_log_odds, "", 0, 5);
  v.number("max_log_odds", max_log_odds, "", 0, 20);
  v.number("min_log_odds", min_log_odds, "", -20, 0);
  v.number("extent_log_odds", extent_log_odds, "", -20, 20);
  v.number("publish_log_odds", publish_log_odds, "", -10, 10);
  v.number("confirm_log_odds", confirm_log_odds, "", -10, 10);
  v.number("existence_at_publish", existence_at_publish, "", 0, 1);
  v.number("existence_at_max", existence_at_max, "", 0, 1);
  v.number("min_birth_length_m", min_birth_length_m, "m", 0, 50);
  v.number("min_length_m", min_length_m, "m", 0.1, 50);
  v.number("merge_distance_m", merge_distance_m, "m", 0, 2);
}

void visit(auto& v, Is<StyleConfig> auto& c) {
  auto& [bin_length_m, min_share] = c;
  v.number("bin_length_m", bin_length_m, "m", 0.2, 100);
  v.number("min_share", min_share, "", 0, 1);
}

void visit(auto& v, Is<BoundaryConfig> auto& c) {
  auto& [max_gap_m, max_angle_deg, max_lateral_m] = c;
  v.number("max_gap_m", max_gap_m, "m", 0, 100);
  v.number("max_angle_deg", max_angle_deg, "deg", 0, 90);
  v.number("max_lateral_m", max_lateral_m, "m", 0, 10);
}

void visit(auto& v, Is<SectionConfig> auto& c) {
  auto& [max_angle_deg, max_distance_m] = c;
  v.number("max_angle_deg", max_angle_deg, "deg", 0, 90);
  v.number("max_distance_m", max_distance_m, "m", 0, 100);
}

void visit(auto& v, Is<LaneConfig> auto& c) {
  auto& [min_width_m, max_width_m, max_kerb_width_m, find_shoulders, max_shoulder_width_m, unmarked_roads,
         min_divided_width_m, one_sided_lanes, assumed_width_m, max_width_variation_m, min_length_m, step_m,
         id_memory_frames] = c;
  v.number("min_width_m", min_width_m, "m", 0.5, 20);
  v.number("max_width_m", max_width_m, "m", 0.5, 20);
  v.number("max_kerb_width_m", max_kerb_width_m, "m", 0.5, 20);
  v.flag("find_shoulders", find_shoulders);
  v.number("max_shoulder_width_m", max_shoulder_width_m, "m", 0.5, 20);
  v.flag("unmarked_roads", unmarked_roads);
  v.number("min_divided_width_m", min_divided_width_m, "m", 1, 40);
  v.flag("one_sided_lanes", one_sided_lanes);
  v.number("assumed_width_m", assumed_width_m, "m", 0.5, 20);
  v.number("max_width_variation_m", max_width_variation_m, "m", 0, 10);
  v.number("min_length_m", min_length_m, "m", 0.5, 100);
  v.number("step_m", step_m, "m", 0.1, 10);
  v.number("id_memory_frames", id_memory_frames, "frames", 0, 10000);
}

void visit(auto& v, Is<LinkageConfig> auto& c) {
  auto& [max_shared_gap_m, max_gap_m, max_lateral_m, max_angle_deg, straight_across, max_crossing_gap_m,
         max_crossing_lateral_m, turns, max_turn_gap_m, min_turn_radius_m] = c;
  v.number("max_shared_gap_m", max_shared_gap_m, "m", 1, 200);
  v.number("max_gap_m", max_gap_m, "m", 2, 200);
  v.number("max_lateral_m", max_lateral_m, "m", 0.1, 10);
  v.number("max_angle_deg", max_angle_deg, "deg", 1, 90);
  v.flag("straight_across", straight_across);
  v.number("max_crossing_gap_m", max_crossing_gap_m, "m", 1, 200);
  v.number("max_crossing_lateral_m", max_crossing_lateral_m, "m", 0.1, 10);
  v.flag("turns", turns);
  v.number("max_turn_gap_m", max_turn_gap_m, "m", 1, 200);
  v.number("min_turn_radius_m", min_turn_radius_m, "m", 0.5, 50);
}

void visit(auto& v, Is<DirectionConfig> auto& c) {
  auto& [driving_side] = c;
  choice(v, "driving_side", driving_side, kDrivingSides);
}

void visit(auto& v, Is<StoplineConfig> auto& c) {
  auto& [max_gap_m, min_angle_deg] = c;
  v.number("max_gap_m", max_gap_m, "m", 0, 50);
  v.number("min_angle_deg", min_angle_deg, "deg", 0, 90);
}

void visit(auto& v, Is<MapperConfig> auto& c) {
  auto& [method, range, preprocess, voxel_map, clustering, polyline, fusion, style, boundary, section, lane,
         linkage, direction, stopline] = c;
  choice(v, "method", method, kFusionMethods);
  v.section("range", range);
  v.section("preprocess", preprocess);
  v.section("voxel_map", voxel_map);
  v.section("clustering", clustering);
  v.section("polyline", polyline);
  v.section("fusion", fusion);
  v.section("style", style);
  v.section("boundary", boundary);
  v.section("section", section);
  v.section("lane", lane);
  v.section("linkage", linkage);
  v.section("direction", direction);
  v.section("stopline", stopline);
}

void visit(auto& v, Is<SyncConfig> auto& c) {
  auto& [max_pose_gap_s, max_wait_s, pose_history_s, queue_capacity, pose_queue_capacity] = c;
  v.number("max_pose_gap_s", max_pose_gap_s, "s", 0.001, 10);
  v.number("max_wait_s", max_wait_s, "s", 0, 10);
  v.number("pose_history_s", pose_history_s, "s", 0.1, 60);
  v.number("queue_capacity", queue_capacity, "frames", 1, 10000);
  v.number("pose_queue_capacity", pose_queue_capacity, "poses", 1, 100000);
}

void visit(auto& v, Is<GateConfig> auto& c) {
  auto& [max_stamp_step_s, max_speed_mps, max_pose_jump_m, max_coordinate_m, max_frame_detections,
         max_frame_length_m] = c;
  v.number("max_stamp_step_s", max_stamp_step_s, "s", 0.01, 60);
  v.number("max_speed_mps", max_speed_mps, "m/s", 1, 200);
  v.number("max_pose_jump_m", max_pose_jump_m, "m", 0.01, 1000);
  v.number("max_coordinate_m", max_coordinate_m, "m", 1000, 1e7);
  v.number("max_frame_detections", max_frame_detections, "", 1, 512);
  v.number("max_frame_length_m", max_frame_length_m, "m", 100, 1e5);
}

void visit(auto& v, Is<ServiceConfig> auto& c) {
  auto& [tick_rate_hz, stale_after_s, degraded_after_s, stale_lag_s, degraded_lag_s, status_period_s,
         log_level, snapshot_file, snapshot_period_s, snapshot_max_age_s] = c;
  // Two maps are at most as far apart as their deadline (250 ms, src/dds/qos.cpp) allows.
  v.number("tick_rate_hz", tick_rate_hz, "Hz", 5, 100);
  v.number("stale_after_s", stale_after_s, "s", 0.05, 60);
  v.number("degraded_after_s", degraded_after_s, "s", 0.05, 60);
  v.number("stale_lag_s", stale_lag_s, "s", 0.1, 60);
  v.number("degraded_lag_s", degraded_lag_s, "s", 0.1, 60);
  v.number("status_period_s", status_period_s, "s", 0.1, 60);
  v.choice("log_level", log_level, "debug|info|warn|error|off");
  v.path("snapshot_file", snapshot_file);
  v.number("snapshot_period_s", snapshot_period_s, "s", 0.1, 60);
  v.number("snapshot_max_age_s", snapshot_max_age_s, "s", 0.1, 60);
}

void visit(auto& v, Is<DdsConfig> auto& c) {
  auto& [domain, vehicle_id, map_frame_id, transport, profile_file, profile_name, security_directory] = c;
  v.number("domain", domain, "", 0, 232);
  v.identifier("vehicle_id", vehicle_id);
  v.identifier("map_frame_id", map_frame_id);
  v.choice("transport", transport, "udp|udp+shm");
  v.path("profile_file", profile_file);
  v.path("profile_name", profile_name);
  v.path("security_directory", security_directory);
}

void visit(auto& v, Is<SdMapConfig> auto& c) {
  auto& [file, origin_latitude_deg, origin_longitude_deg] = c;
  v.path("file", file);
  v.number("origin_latitude_deg", origin_latitude_deg, "deg", -90, 90);
  v.number("origin_longitude_deg", origin_longitude_deg, "deg", -180, 180);
}

void visit(auto& v, Is<Ros2Config> auto& c) {
  auto& [enabled, ros_namespace, distro, announce, odometry_topic, road_segments_topic] = c;
  v.flag("enabled", enabled);
  v.path("namespace", ros_namespace);
  v.choice("distro", distro, "humble|jazzy");
  v.flag("announce", announce);
  v.path("odometry_topic", odometry_topic);
  v.path("road_segments_topic", road_segments_topic);
}

void visit(auto& v, Is<Config> auto& c) {
  auto& [mapper, sd_map, sync, gate, service, dds, ros2] = c;
  v.section("mapper", mapper);
  v.section("sd_map", sd_map);
  v.section("sync", sync);
  v.section("gate", gate);
  v.section("service", service);
  v.section("dds", dds);
  v.section("ros2", ros2);
}

}  // namespace laneloom::config
