#pragma once

#include <cstdint>
#include <string>

#include "laneloom/network_profile.hpp"

/// Every parameter, with its default here and nowhere else. Angles are in degrees, as people write them.
/// Units and ranges are checked when a file is read (src/config); "ours" marks a choice that the paper leaves
/// open.
namespace laneloom {

/// The part of the world that is mapped: a box in the body frame (paper, Sec. IV-C).
struct RangeConfig {
  double forward_min_m = -5.0;
  double forward_max_m = 30.0;
  double side_max_m = 15.0;
  /// What is this far beyond the box is kept, so that it has gathered evidence when it enters. Lines are
  /// published there too, as far as they have it. Ours.
  double margin_forward_m = 25.0;
  double margin_side_m = 5.0;
};

/// Paper, Sec. III-A. A turn above `zigzag_angle_deg` between consecutive segments is a zig or a zag. Ours.
struct PreprocessConfig {
  bool reject_zigzag = true;
  double min_confidence = 0.3;
  double zigzag_angle_deg = 60.0;
  int zigzag_turns = 2;               ///< so many of them reject the polyline
  double zigzag_min_segment_m = 0.3;  ///< shorter segments carry no angle and are skipped
};

/// Paper, Sec. III-B.
struct VoxelMapConfig {
  double voxel_size_m = 0.2;
  double voxel_height_m = 0.5;  ///< ours: a pitch error of 1 degree is 0.5 m at 30 m
  double sample_step_m = 0.1;   ///< ours: along a detected polyline
  int min_detections = 10;      ///< alpha_n: reliable is what was detected more often
  int remembered_frames = 300;  ///< ours: older frames are forgotten, in counts and co-observation alike
};

/// Paper, Sec. III-C-1.
struct ClusteringConfig {
  double min_probability = 0.6;  ///< beta_p
  int min_voxels = 3;            ///< beta_n
  double min_ratio = 0.7;        ///< beta_r
  /// Instead of these three: the nearest instance that was ever co-observed (paper, Sec. IV-F).
  bool nearest_instance = false;
};

/// Paper, Sec. III-C-2; the values are ours.
struct PolylineConfig {
  double straight_ratio = 0.02;  ///< lambda_2 / lambda_1 below: divided along PC1 only
  double segment_length_m = 4.0;
  double curve_segment_length_m = 2.0;  ///< within a quadrant
  int min_voxels = 20;                  ///< smaller instances are not vectorised (stoplines: half of it)
  double min_length_m = 3.0;            ///< shorter polylines are not vectorised (stoplines: half of it)
};

/// Paper, Sec. IV-E: styles from matching the fused boundaries with the detections. The values are ours.
struct StyleConfig {
  double bin_length_m = 2.0;  ///< along the boundary, one vote each
  double min_share = 0.6;     ///< of the votes that the style needs; else it is unknown
};

/// Paper, Sec. III-D-1; the values are ours.
struct BoundaryConfig {
  double max_gap_m = 5.0;  ///< between the end points that are joined
  double max_angle_deg = 20.0;
  double max_lateral_m = 0.8;  ///< of one end from the other's extension
};

/// Paper, Sec. III-D-2; the values are ours.
struct SectionConfig {
  double max_angle_deg = 25.0;   ///< "similar direction"
  double max_distance_m = 13.0;  ///< a projection from further away is no overlap
};

/// Paper, Sec. III-D-3; the values are ours.
struct LaneConfig {
  double min_width_m = 2.1;
  double max_width_m = 4.5;
  double max_kerb_width_m = 6.5;      ///< beside a roadedge: room to park; also the room beside one line
  bool find_shoulders = true;         ///< tells shoulders from lanes
  double max_shoulder_width_m = 3.0;  ///< between an edge and a lane's solid line
  bool unmarked_roads = true;         ///< divides roads without lines into two lanes
  double min_divided_width_m = 6.5;   ///< from which it does
  bool one_sided_lanes = true;        ///< assumes lanes beside a line with nothing else on that side
  double assumed_width_m = 3.3;       ///< of these
  double max_width_variation_m = 0.8;
  double min_length_m = 4.0;
  double step_m = 1.0;        ///< between cross-sections, and so between the points of a centerline
  int id_memory_frames = 50;  ///< a lane that comes back within so many frames keeps its id
};

/// Paper, Sec. III-D-4; the values are ours.
struct LinkageConfig {
  double max_shared_gap_m = 20.0;  ///< along a shared boundary, between the lanes' ends
  double max_gap_m = 5.0;          ///< between centerlines that are aligned
  double max_lateral_m = 1.2;
  double max_angle_deg = 20.0;
  // Straight on across an intersection, where no marking leads. Beyond the paper.
  bool straight_across = true;
  double max_crossing_gap_m = 35.0;
  double max_crossing_lateral_m = 1.5;
  // Left and right turns there: from either lane's end to where their extensions meet.
  bool turns = true;
  double max_turn_gap_m = 25.0;
  double min_turn_radius_m = 3.0;
};

/// Of the road, that traffic keeps to.
enum class DrivingSide : std::uint8_t { right, left, unknown };
inline constexpr const char* kDrivingSides = "right|left|unknown";

/// Which way the traffic of a lane runs. Ours.
struct DirectionConfig {
  DrivingSide driving_side = DrivingSide::right;
};

/// Which lanes a stopline ends. Ours.
struct StoplineConfig {
  double max_gap_m = 3.0;       ///< from the lane's end, or past it
  double min_angle_deg = 45.0;  ///< between stopline and lane
};

/// Fusion along lines: every line of the map is a row of stations, each with its own lateral estimate and
/// evidence. Instead of the paper's Sec. III-B and III-C. Ours.
struct FusionConfig {
  double sample_step_m = 1.0;      ///< along a detection
  double station_spacing_m = 1.0;  ///< along a line
  // Which detection observes which line.
  double gate_m = 0.6;  ///< lateral
  double gate_angle_deg = 25.0;
  double min_overlap_m = 2.0;
  // How well an observation tells the lateral position.
  bool learn = true;             ///< how each source errs: from what is later seen from near
  std::string profile_file;      ///< what is known of the networks to begin with; empty: nothing
  double stddev_m = 0.03;        ///< at the vehicle, before anything is learned
  double stddev_per_m = 0.0035;  ///< more, per metre from it
  double bias_stddev_m =
      0.1;              ///< of what lasts from far to near: it does not average out, and is not learned
  double fade_m = 5.0;  ///< over which an extension is faded to the line
  // Evidence that a line exists at a station, as log odds.
  double birth_log_odds = -1.5;
  double extension_log_odds = -0.5;
  double hit_log_odds = 0.4;    ///< gained by an observation of confidence 0.5
  double miss_log_odds = 0.13;  ///< a miss counts so much, times the log of how seldom the network misses
  double max_log_odds = 6.0;
  double min_log_odds = -4.0;     ///< below, a station is taken away
  double extent_log_odds = -1.0;  ///< a line reaches to the last station with as much
  double publish_log_odds = 0.5;  ///< of the line, from which it is published
  double confirm_log_odds = 2.0;
  double existence_at_publish = 0.45;  ///< probability that a line exists whose evidence is publish_log_odds
  double existence_at_max = 0.99;      ///< and one whose evidence is max_log_odds
  double min_birth_length_m = 2.0;
  double min_length_m = 2.0;      ///< of what is published
  double merge_distance_m = 1.0;  ///< lines closer than this that are not seen together are one
};

/// The method by which detections of several frames become one line.
enum class FusionMethod : std::uint8_t {
  lines,  ///< ours
  voxels  ///< the paper's
};
inline constexpr const char* kFusionMethods = "lines|voxels";

/// All that the mapper needs to know.
struct MapperConfig {
  FusionMethod method = FusionMethod::lines;
  RangeConfig range;
  PreprocessConfig preprocess;
  VoxelMapConfig voxel_map;
  ClusteringConfig clustering;
  PolylineConfig polyline;
  FusionConfig fusion;
  StyleConfig style;
  BoundaryConfig boundary;
  SectionConfig section;
  LaneConfig lane;
  LinkageConfig linkage;
  DirectionConfig direction;
  StoplineConfig stopline;
  NetworkProfiles networks;  ///< what fusion.profile_file tells; it is not part of the configuration's text
};

/// Synchronisation of detections with poses.
struct SyncConfig {
  double max_pose_gap_s = 0.2;  ///< between the two poses that bracket a stamp
  double max_wait_s = 0.5;      ///< for the bracketing pose, since the frame's arrival
  double pose_history_s = 5.0;
  int queue_capacity = 64;  ///< detection frames; the oldest is dropped
  int pose_queue_capacity = 2048;
};

/// When input is not believed. Three consistent outliers in a row are believed, and reset the map.
struct GateConfig {
  double max_stamp_step_s = 2.0;  ///< a stamp further from its predecessor is an outlier
  double max_speed_mps = 80.0;
  double max_pose_jump_m = 2.0;  ///< beyond what the speed explains
  double max_coordinate_m = 1e7;
  int max_frame_detections = 128;      ///< of more, the least trusted are left out; it bounds the work
  double max_frame_length_m = 2000.0;  ///< of all markings of a frame together, likewise
};

/// The service process: its rate, the limits beyond which it warns of its map, its log, and what it keeps for
/// a restart.
struct ServiceConfig {
  double tick_rate_hz = 10.0;
  double stale_after_s = 0.4;      ///< without a fused frame, the map is STALE
  double degraded_after_s = 0.25;  ///< without detections or poses, it is DEGRADED
  double stale_lag_s = 1.0;        ///< by stamps, fused frames that are older than the poses make it STALE
  double degraded_lag_s = 0.5;     ///< and DEGRADED
  double status_period_s = 1.0;
  std::string log_level = "info";
  std::string snapshot_file;  ///< what a restarted service goes on with; empty: none
  double snapshot_period_s = 1.0;
  double snapshot_max_age_s = 5.0;  ///< an older one is refused
};

/// The service's place in DDS: domain, partition, transport, security.
struct DdsConfig {
  int domain = 0;
  std::string vehicle_id = "ego";  ///< names the DDS partition
  std::string map_frame_id = "map";
  std::string transport = "udp";   ///< udp, or udp+shm: shared memory is for participants of one user
  std::string profile_file;        ///< Fast DDS XML profile; empty: none
  std::string profile_name;        ///< of a participant in the file
  std::string security_directory;  ///< DDS-Security: an identity and what it may do; empty: open to all
};

/// A standard-definition map that supplies and confirms linkages across intersections (paper, Sec. III-D-4).
struct SdMapConfig {
  std::string file;  ///< OpenStreetMap extract (XML); empty: none
  // Where on earth the map frame's origin is: x points east, y north. WGS84.
  double origin_latitude_deg = 0.0;
  double origin_longitude_deg = 0.0;
};

/// What nodes of ROS 2 see of the service, on a participant of its own. Names without a leading '/' are below
/// the namespace.
struct Ros2Config {
  bool enabled = false;
  std::string ros_namespace;            ///< of this vehicle, "/car_1"; empty: none
  std::string distro = "jazzy";         ///< humble or jazzy; only `announce` depends on it
  bool announce = false;                ///< show a node in `ros2 node list`
  std::string odometry_topic = "odom";  ///< nav_msgs/Odometry
  std::string road_segments_topic =
      "laneloom/road_segments";  ///< autoware_mapless_planning_msgs/RoadSegments
};

/// Everything that a configuration file can say.
struct Config {
  MapperConfig mapper;
  SdMapConfig sd_map;
  SyncConfig sync;
  GateConfig gate;
  ServiceConfig service;
  DdsConfig dds;
  Ros2Config ros2;
};

}  // namespace laneloom
