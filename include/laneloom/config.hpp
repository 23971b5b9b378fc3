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
  double forward_min_m = -5.0;  ///< rear end of the box: its distance ahead of the body frame's origin
  double forward_max_m = 30.0;  ///< front end of the box, likewise
  double side_max_m = 15.0;     ///< half of the width of the box
  /// The map also keeps what lies up to this far in front of and behind the box, so that a line has evidence
  /// when it enters the box. The method `lines` also publishes it. Ours.
  double margin_forward_m = 25.0;
  double margin_side_m = 5.0;  ///< the same to the left and right of the box
};

/// Detections that are dropped (paper, Sec. III-A). A turn above `zigzag_angle_deg` between consecutive
/// segments is a zig or a zag. Ours.
struct PreprocessConfig {
  bool reject_zigzag = true;          ///< whether polylines that zigzag are dropped
  double min_confidence = 0.3;        ///< 0..1; a detection with a lower confidence is dropped
  double zigzag_angle_deg = 60.0;     ///< a larger turn counts
  int zigzag_turns = 2;               ///< a polyline with so many is dropped; a road edge with one more
  double zigzag_min_segment_m = 0.3;  ///< shorter segments carry no angle and are skipped
};

/// The semantic voxel map (paper, Sec. III-B).
struct VoxelMapConfig {
  double voxel_size_m = 0.2;    ///< horizontal edge of a voxel
  double voxel_height_m = 0.5;  ///< vertical edge. Ours: a pitch error of 1 degree is 0.5 m at 30 m
  double sample_step_m = 0.1;   ///< between the samples along a detection that hit voxels. Ours
  int min_detections = 10;      ///< alpha_n: a voxel that was detected more often is reliable
  int remembered_frames = 300;  ///< counts and co-observations of older frames are forgotten. Ours
};

/// Voxels to instances (paper, Sec. III-C-1). A voxel joins an instance that satisfies beta_n or beta_r.
struct ClusteringConfig {
  double min_probability = 0.6;  ///< beta_p: two voxels are co-observed with a higher probability than this
  int min_voxels = 3;            ///< beta_n: more voxels of the instance are co-observed with the voxel
  double min_ratio = 0.7;        ///< beta_r: a larger share of the instance's voxels is co-observed with it
  /// Instead of these three tests, a voxel joins the nearest instance that it was ever co-observed with
  /// (paper, Sec. IV-F).
  bool nearest_instance = false;
};

/// Instances to polylines (paper, Sec. III-C-2); the values are ours.
struct PolylineConfig {
  /// An instance counts as straight, and is divided along its first principal component alone, if lambda_2 is
  /// less than this share of lambda_1.
  double straight_ratio = 0.02;
  double segment_length_m = 4.0;        ///< of a straight instance's groups
  double curve_segment_length_m = 2.0;  ///< of the groups within a quadrant of a curved instance
  int min_voxels = 20;                  ///< smaller instances are not vectorised (stoplines: half of it)
  double min_length_m = 3.0;            ///< shorter polylines are not vectorised (stoplines: half of it)
};

/// Styles from matching the fused boundaries with the detections (paper, Sec. IV-E). The values are ours.
struct StyleConfig {
  double bin_length_m = 2.0;  ///< of the pieces of a boundary that get one style each, by the method `voxels`
  double min_share = 0.6;     ///< 0..1, of the votes that a style needs; with less, the style is unknown
};

/// Limits within which ends of markings are joined to one boundary (paper, Sec. III-D-1). The values are
/// ours.
struct BoundaryConfig {
  double max_gap_m = 5.0;       ///< between the two end points
  double max_angle_deg = 20.0;  ///< between the directions of the two ends
  double max_lateral_m = 0.8;   ///< of one end from the other's extension
};

/// Limits within which boundaries are grouped into one road section (paper, Sec. III-D-2). The values are
/// ours.
struct SectionConfig {
  double max_angle_deg = 25.0;   ///< directions that differ by less are "similar"
  double max_distance_m = 16.0;  ///< boundaries further apart do not overlap
};

/// How lanes are found between boundaries.
enum class LaneMethod : std::uint8_t {
  scored,  ///< by a sum of log odds
  paper    ///< as in the paper (Sec. III-D-3): by limits of the width alone, and nothing is inferred
};
/// The enumerators of LaneMethod, as a configuration file spells them.
inline constexpr const char* kLaneMethods = "scored|paper";

/// Boundaries to lanes (paper, Sec. III-D-3); the values are ours.
struct LaneConfig {
  LaneMethod method = LaneMethod::scored;
  double min_width_m = 2.3;           ///< narrower strips rather are no lanes
  double max_width_m = 4.5;           ///< wider strips between lines rather are no lanes
  double max_kerb_width_m = 6.5;      ///< wider strips beside a roadedge rather are no lanes
  bool find_side_strips = true;       ///< tells shoulders and cycle lanes from lanes
  double max_shoulder_width_m = 3.2;  ///< a shoulder, between a roadedge and a lane's solid line, is narrower
  bool publish_side_strips = false;   ///< method scored: shoulders and the like are lanes with that use
  bool unmarked_roads = true;         ///< divides roads without lines into two lanes
  double min_divided_width_m = 6.5;   ///< narrower roads without lines rather are one lane
  bool one_sided_lanes = true;        ///< infers lanes beside a line with nothing else on that side
  double assumed_width_m = 3.3;       ///< width of such an inferred lane
  double max_width_variation_m = 1.6;  ///< method paper: between the widest and the narrowest place of a lane
  double min_length_m = 4.0;           ///< shorter lanes are not built
  double step_m = 1.0;                 ///< between cross-sections, and so between the points of a centerline
  int id_memory_frames = 50;  ///< an inferred boundary that comes back within this many frames keeps its id
};

/// Limits within which lanes are linked (paper, Sec. III-D-4). The values are ours.
struct LinkageConfig {
  double max_shared_gap_m = 20.0;  ///< between the ends of lanes along one boundary, measured along it
  double max_gap_m = 5.0;          ///< between the ends of lanes with aligned centerlines
  double max_lateral_m = 1.2;      ///< between aligned centerlines
  double max_angle_deg = 20.0;     ///< between lanes that are linked by alignment or straight across
  // Straight on across an intersection, where no marking leads. Beyond the paper.
  bool straight_across = true;          ///< whether such lanes are linked
  double max_crossing_gap_m = 35.0;     ///< between the ends of lanes that are linked straight across
  double max_crossing_lateral_m = 1.5;  ///< lateral offset of lanes that are linked straight across
  // Left and right turns at an intersection.
  bool turns = true;               ///< whether lanes are linked by such turns
  double max_turn_gap_m = 25.0;    ///< from either lane's end to where the extensions of the lanes meet
  double min_turn_radius_m = 3.0;  ///< an arc of this radius must fit between the lanes
};

/// The side of the road that traffic keeps to.
enum class DrivingSide : std::uint8_t { right, left, unknown };
/// The enumerators of DrivingSide, as a configuration file spells them.
inline constexpr const char* kDrivingSides = "right|left|unknown";

/// How the direction of traffic in a lane is found. Ours.
struct DirectionConfig {
  DrivingSide driving_side = DrivingSide::right;  ///< tells in which of two lanes oncoming traffic runs
};

/// The kinds of evidence that count beside the detections. A kind that does not count leaves the map as if
/// its source had never told anything. Ours.
struct EvidenceConfig {
  bool traffic = true;   ///< the trails of other vehicles (Evidence::traffic)
  bool sd_map = true;    ///< the streets of the SD map (Evidence::sd_map)
  bool ego_path = true;  ///< the vehicle's own drive (Evidence::ego_path)
};

/// Limits within which a stopline holds the traffic of a lane. Ours.
struct StoplineConfig {
  double max_gap_m = 3.0;       ///< before or behind a lane's end
  double min_angle_deg = 45.0;  ///< between stopline and lane
};

/// Fusion along lines: every line of the map is a row of stations, each with its own lateral estimate and
/// evidence. Instead of the paper's Sec. III-B and III-C. Ours.
struct FusionConfig {
  double sample_step_m = 1.0;      ///< between the samples along a detection
  double station_spacing_m = 1.0;  ///< between the stations along a line
  // A detection observes a line only within these.
  double gate_m = 0.6;           ///< largest lateral distance between the two
  double gate_angle_deg = 25.0;  ///< largest angle between the two
  double min_overlap_m = 2.0;    ///< the two run along each other for at least this length
  // The accuracy of an observation's lateral position.
  bool learn = true;             ///< whether the mapper learns how each source errs, from later near views
  std::string profile_file;      ///< profiles of networks to start with; empty: none
  double stddev_m = 0.03;        ///< lateral, at the vehicle, before anything is learned
  double stddev_per_m = 0.0035;  ///< growth of the lateral deviation per metre of distance, likewise
  /// Standard deviation of the lateral error that lasts from far to near. It does not average out, and is not
  /// learned.
  double bias_stddev_m = 0.14;
  double fade_m = 5.0;  ///< the lateral step between an extension and its line fades out over this length
  // Evidence that a line exists at a station, as log odds.
  double birth_log_odds = -1.5;        ///< of the stations of a new line
  double extension_log_odds = -0.5;    ///< of a new station that extends a line
  double hit_log_odds = 0.4;           ///< gained by an observation that is believed by half
  double miss_log_odds = 0.13;         ///< a miss adds this times ln(1 - the network's rate of detection)
  double max_log_odds = 6.0;           ///< upper limit of a station
  double min_log_odds = -4.0;          ///< a station below this is removed
  double extent_log_odds = -1.0;       ///< a published line ends with the outermost stations of at least this
  double publish_log_odds = 0.5;       ///< a line with at least this is published
  double confirm_log_odds = 2.0;       ///< a published line with at least this is confirmed, else tentative
  double existence_at_publish = 0.45;  ///< existence probability of a line with publish_log_odds
  double existence_at_max = 0.94;      ///< likewise with log odds of 5, or max_log_odds if lower
  double min_birth_length_m = 2.0;     ///< a shorter part of a detection starts no line
  double min_length_m = 2.0;           ///< shorter lines are not published
  double merge_distance_m = 1.0;       ///< lines closer than this that are not seen together are one
};

/// The method by which detections of several frames become one line.
enum class FusionMethod : std::uint8_t {
  lines,  ///< ours
  voxels  ///< the paper's
};
/// The enumerators of FusionMethod, as a configuration file spells them.
inline constexpr const char* kFusionMethods = "lines|voxels";

/// The configuration of the mapper.
struct MapperConfig {
  FusionMethod method = FusionMethod::lines;
  RangeConfig range;
  PreprocessConfig preprocess;
  VoxelMapConfig voxel_map;     ///< of the method `voxels`
  ClusteringConfig clustering;  ///< of the method `voxels`
  PolylineConfig polyline;      ///< of the method `voxels`
  FusionConfig fusion;          ///< of the method `lines`
  StyleConfig style;
  BoundaryConfig boundary;
  SectionConfig section;
  LaneConfig lane;
  LinkageConfig linkage;
  DirectionConfig direction;
  StoplineConfig stopline;
  EvidenceConfig evidence;
  NetworkProfiles networks;  ///< content of fusion.profile_file; not part of the configuration's text
};

/// Synchronisation of detections with poses.
struct SyncConfig {
  double max_pose_gap_s = 0.2;     ///< between the two poses that bracket a stamp
  double max_wait_s = 0.5;         ///< for the bracketing pose, since the frame's arrival
  double pose_history_s = 5.0;     ///< older poses are forgotten
  int queue_capacity = 64;         ///< detection frames between two ticks; of more, the oldest are dropped
  int pose_queue_capacity = 2048;  ///< poses between two ticks; of more, the oldest are dropped
};

/// Limits beyond which input is not believed. Three outliers in a row that agree with one another are
/// believed, and reset the map.
struct GateConfig {
  double max_stamp_step_s = 2.0;       ///< a stamp further from its predecessor is an outlier
  double max_speed_mps = 80.0;         ///< highest speed of the vehicle that is believed
  double max_pose_jump_m = 2.0;        ///< beyond what that speed explains; a longer jump is an outlier
  double max_turn_rate_degps = 120.0;  ///< quickest turn of the vehicle that is believed
  double max_pose_turn_deg = 15.0;     ///< beyond what that rate explains; a larger turn is an outlier
  double max_coordinate_m = 1e7;       ///< messages with larger coordinates are refused
  int max_frame_detections = 128;      ///< of more, the least trusted are left out; it bounds the work
  double max_frame_length_m = 2000.0;  ///< of all markings of a frame together, likewise
};

/// The service process: its rate, the limits beyond which it warns of its map, its log, and what it keeps for
/// a restart.
struct ServiceConfig {
  double tick_rate_hz = 10.0;       ///< how often the map is published; at least 8
  double stale_after_s = 0.4;       ///< without a fused frame, the map is STALE
  double degraded_after_s = 0.25;   ///< without detections or poses, it is DEGRADED
  double stale_lag_s = 1.0;         ///< by stamps, fused frames that are older than the poses make it STALE
  double degraded_lag_s = 0.5;      ///< and DEGRADED
  double status_period_s = 1.0;     ///< between two status messages while the state does not change
  std::string log_level = "info";   ///< least severe level that is logged: debug, info, warn, error, off
  std::string snapshot_file;        ///< the map that a restarted service goes on with; empty: none
  double snapshot_period_s = 1.0;   ///< between two writes of the snapshot
  double snapshot_max_age_s = 5.0;  ///< an older snapshot is refused at the start
};

/// The service's place in DDS: domain, partition, transport, security.
struct DdsConfig {
  int domain = 0;                    ///< 0..232
  std::string vehicle_id = "ego";    ///< names the DDS partition; vehicles of different ids never mix
  std::string map_frame_id = "map";  ///< names the frame of the poses and the map
  std::string transport = "udp";     ///< udp, or udp+shm: shared memory is for participants of one user
  std::string profile_file;          ///< Fast DDS XML profile; empty: none
  std::string profile_name;          ///< of a participant in the file
  std::string security_directory;    ///< DDS-Security: an identity and its permissions; empty: open to all
};

/// A standard-definition map that supplies and confirms linkages across intersections (paper, Sec. III-D-4).
struct SdMapConfig {
  std::string file;  ///< OpenStreetMap extract (XML); empty: none
  // The map frame's origin on earth (WGS84). With an SD map, x of the map frame points east, and y north.
  double origin_latitude_deg = 0.0;   ///< -90..90
  double origin_longitude_deg = 0.0;  ///< -180..180
};

/// The service's place among nodes of ROS 2, on a participant of its own. Names without a leading '/' are in
/// the namespace.
struct Ros2Config {
  bool enabled = false;          ///< whether the service also takes input from ROS 2 and publishes there
  std::string ros_namespace;     ///< of this vehicle, "/car_1"; empty: none
  std::string distro = "jazzy";  ///< humble or jazzy; only `announce` depends on it
  bool announce = false;         ///< show a node in `ros2 node list`
  std::string odometry_topic = "odom";  ///< of the vehicle's poses (nav_msgs/Odometry)
  /// Topic of other vehicles (autoware_perception_msgs/TrackedObjects).
  std::string objects_topic = "tracked_objects";
  /// Topic of the map in the vehicle's frame (autoware_mapless_planning_msgs/RoadSegments).
  std::string road_segments_topic = "laneloom/road_segments";
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
