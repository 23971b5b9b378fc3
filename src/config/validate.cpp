#include "validate.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include "base/dds_values.hpp"
#include "base/ros_name.hpp"
#include "base/vehicle_frame.hpp"
#include "config/config_file.hpp"
#include "schema.hpp"
#include "text.hpp"

namespace laneloom::config {
namespace {

class RangeCheck {
 public:
  template <class C>
  void section(const char* key, const C& child, const char* /*meaning*/) {
    const std::string outer = prefix_;
    prefix_ += std::string(key) + ".";
    visit(*this, child);
    prefix_ = outer;
  }
  void number(const char* key, double value, const Limits& limits, const char* /*meaning*/) {
    const bool inside = value >= limits.min && value <= limits.max;  // false for NaN
    if (!inside) report(key, to_text(value) + " is not in " + range_text(limits.min, limits.max));
  }
  void flag(const char* /*key*/, bool /*value*/, const char* /*meaning*/) {}
  void choice(const char* key, const std::string& value, const char* choices, const char* /*meaning*/) {
    if (!is_choice(choices, value)) report(key, "\"" + value + "\" is none of " + choices);
  }
  void identifier(const char* key, const std::string& value, const char* /*meaning*/) {
    if (const std::string what = identifier_problem(value); !what.empty()) report(key, what);
  }
  void path(const char* /*key*/, const std::string& /*value*/, const char* /*meaning*/) {}

  std::optional<Problem> problem;

 private:
  void report(const char* key, std::string what) {
    if (!problem) problem = Problem{prefix_ + key, std::move(what)};
  }

  std::string prefix_;
};

/// The greatest length of a published line: the longer side of the range with its margins, and more for
/// curves.
double longest_line_m(const RangeConfig& range) {
  constexpr double kCurves = 1.5;
  const double forward_m = range.forward_max_m - range.forward_min_m + 2.0 * range.margin_forward_m;
  const double side_m = 2.0 * (range.side_max_m + range.margin_side_m);
  return kCurves * std::max(forward_m, side_m);
}

/// Finds a spacing of points that is too small for the range: a line with more points than a message holds
/// would always be left out.
std::optional<Problem> find_too_many_points(const MapperConfig& mapper) {
  constexpr double kMaxPoints = 1024;  // MAX_POINTS of idl/Common.idl
  const double least_m = longest_line_m(mapper.range) / kMaxPoints;
  const std::string what =
      "must exceed " + to_text(least_m) + " m at this range, or messages cannot hold the lines";
  if (mapper.lane.step_m <= least_m) return Problem{"mapper.lane.step_m", what};
  if (mapper.method == FusionMethod::lines && mapper.fusion.station_spacing_m <= least_m) {
    return Problem{"mapper.fusion.station_spacing_m", what};
  }
  return std::nullopt;
}

/// Whether a name is one of ROS 2: tokens of letters, digits and '_', none of which begins with a digit,
/// divided by '/'.
bool is_ros_name(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  if (name.starts_with('/')) name.remove_prefix(1);
  bool begins = true;  // a token begins here
  for (const char c : name) {
    const bool fits = is_letter(c) || (!begins && ((c >= '0' && c <= '9') || c == '/'));
    if (!fits) return false;
    begins = c == '/';
  }
  return !begins;
}

std::optional<Problem> find_wrong_name(const Ros2Config& ros2) {
  constexpr std::size_t kMaxLength = 100;  // of the namespace and of a topic: DDS takes 255 characters in all
  const auto problem = [](const char* key, const std::string& name) {
    return Problem{std::string("ros2.") + key,
                   "\"" + name + "\" is no name of ROS 2, or has more than 100 characters"};
  };
  const auto fits = [](const std::string& name) { return name.size() <= kMaxLength && is_ros_name(name); };
  if (!ros2.ros_namespace.empty() && !fits(ros2.ros_namespace))
    return problem("namespace", ros2.ros_namespace);
  if (!fits(ros2.odometry_topic)) return problem("odometry_topic", ros2.odometry_topic);
  if (!fits(ros2.objects_topic)) return problem("objects_topic", ros2.objects_topic);
  if (!fits(ros2.road_segments_topic)) return problem("road_segments_topic", ros2.road_segments_topic);
  return std::nullopt;
}

/// Finds a topic of ROS 2 with the name of another one: each has a type of its own.
std::optional<Problem> find_equal_names(const Ros2Config& ros2) {
  std::set<std::string> taken;
  for (const auto* fixed : {"laneloom/detections", "laneloom/lane_map", "laneloom/markers", "/diagnostics"})
    taken.insert(full_ros_name(ros2, fixed));
  const auto problem = [&](const char* key, const std::string& name) -> std::optional<Problem> {
    if (taken.insert(full_ros_name(ros2, name)).second) return std::nullopt;
    return Problem{std::string("ros2.") + key,
                   "\"" + name + "\" is the name of another topic of the service"};
  };
  if (auto found = problem("odometry_topic", ros2.odometry_topic)) return found;
  if (auto found = problem("objects_topic", ros2.objects_topic)) return found;
  return problem("road_segments_topic", ros2.road_segments_topic);
}

std::optional<Problem> find_contradiction(const MapperConfig& mapper) {
  if (mapper.range.forward_min_m >= mapper.range.forward_max_m) {
    return Problem{"mapper.range.forward_min_m", "must be less than forward_max_m"};
  }
  if (mapper.voxel_map.sample_step_m > mapper.voxel_map.voxel_size_m) {
    return Problem{"mapper.voxel_map.sample_step_m", "must not exceed voxel_size_m, or voxels are skipped"};
  }
  if (mapper.voxel_map.min_detections >= mapper.voxel_map.remembered_frames) {
    return Problem{"mapper.voxel_map.min_detections",
                   "must be less than remembered_frames, or nothing is ever reliable"};
  }
  if (mapper.fusion.birth_log_odds < mapper.fusion.min_log_odds) {
    return Problem{"mapper.fusion.birth_log_odds", "must not be below min_log_odds, or nothing is mapped"};
  }
  if (mapper.fusion.extension_log_odds < mapper.fusion.min_log_odds) {
    return Problem{"mapper.fusion.extension_log_odds", "must not be below min_log_odds, or no line grows"};
  }
  if (std::max(mapper.fusion.extent_log_odds, mapper.fusion.publish_log_odds) > mapper.fusion.max_log_odds) {
    return Problem{"mapper.fusion.max_log_odds",
                   "must not be below extent_log_odds and publish_log_odds, or nothing is published"};
  }
  if (mapper.lane.min_width_m >= mapper.lane.max_width_m) {
    return Problem{"mapper.lane.min_width_m", "must be less than max_width_m"};
  }
  if (const LaneConfig& lane = mapper.lane;
      lane.one_sided_lanes &&
      (lane.assumed_width_m < lane.min_width_m || lane.assumed_width_m > lane.max_kerb_width_m)) {
    return Problem{"mapper.lane.assumed_width_m",
                   "must be from min_width_m to max_kerb_width_m, or one_sided_lanes false"};
  }
  return find_too_many_points(mapper);
}

std::optional<Problem> find_contradiction(const DdsConfig& dds) {
  if (dds.map_frame_id == kBodyFrame || dds.map_frame_id == kBaseLink)
    return Problem{"dds.map_frame_id", "\"" + dds.map_frame_id + "\" names the frame of the vehicle"};
  if (dds.profile_file.empty() != dds.profile_name.empty())
    return Problem{"dds.profile_file", "profile_file and profile_name are given together or not at all"};
  return std::nullopt;
}

std::optional<Problem> find_contradiction(const Config& c) {
  if (auto problem = find_contradiction(c.mapper)) return problem;
  if (c.sync.pose_history_s <= c.sync.max_pose_gap_s) {
    return Problem{"sync.pose_history_s", "must exceed max_pose_gap_s"};
  }
  if (c.service.degraded_lag_s > c.service.stale_lag_s) {
    return Problem{"service.degraded_lag_s", "must not exceed stale_lag_s"};
  }
  if (c.service.degraded_after_s > c.service.stale_after_s) {
    return Problem{"service.degraded_after_s", "must not exceed stale_after_s"};
  }
  if (auto problem = find_contradiction(c.dds)) return problem;
  if (auto problem = find_wrong_name(c.ros2)) return problem;
  return find_equal_names(c.ros2);
}

}  // namespace

std::optional<Problem> find_problem(const Config& config) {
  RangeCheck check;
  visit(check, config);
  return check.problem ? check.problem : find_contradiction(config);
}

void validate(const Config& config) {
  if (const auto problem = find_problem(config)) throw ConfigError(problem->key + ": " + problem->what);
}

std::vector<std::string> preset_names() { return {"inhouse", "av2"}; }

void apply_preset(Config& config, std::string_view preset) {
  auto& range = config.mapper.range;
  if (preset == "inhouse") {
    range.forward_min_m = -5.0;
    range.forward_max_m = 30.0;
    config.mapper.voxel_map.min_detections = 10;
  } else if (preset == "av2") {
    range.forward_min_m = -30.0;
    range.forward_max_m = 20.0;
    config.mapper.voxel_map.min_detections = 3;
  } else {
    throw ConfigError("preset: \"" + std::string(preset) + "\" is none of inhouse|av2");
  }
  range.side_max_m = 15.0;
}

}  // namespace laneloom::config
