#include "simulation/noise_profile.hpp"

#include <stdexcept>

namespace laneloom {
namespace {

// Missed shares, ghost rates, error factors and flutter come from `laneloom-lab calibrate`, which fits them
// to the paper's MapTR rows (tools/evaluation/README.md). The rest was chosen after what real networks were
// seen to do: lateral errors of median and 90 % 0.09 and 0.43 m at 0-10 m, 0.13 and 0.65 m at 10-20 m, 0.16
// and 0.86 m at 20-30 m, that last as long as a line is seen; ends that swing, near-duplicates, swapped
// classes.
NoiseProfile inhouse() {
  return {.name = "inhouse",
          .offset_stddev_m = 0.12,
          .offset_stddev_per_m = 0.001,
          .rotation_stddev_deg = 0.1,
          .line_memory_s = 30.0,
          .poor_share = 0.12,
          .poor_dwell_s = 0.3,
          .poor_stddev_m = 0.4,
          .poor_stddev_per_m = 0.01,
          .error_factor = {1.5, 1.33, 0.95},
          .flutter_stddev_m = 0.034,
          .end_swing_stddev_m = 0.15,
          .end_shift_stddev_m = 0.8,
          .end_memory_s = 1.5,
          .point_stddev_m = 0.01,
          .frame_yaw_stddev_deg = 0.1,
          .frame_pitch_stddev_deg = 0.2,
          .frame_longitudinal_stddev_m = 0.1,
          .frame_memory_s = 1.0,
          .missed_share = {0.075, 0.14, 0.0},
          .missed_share_per_m = 0.002,
          .missed_dwell_s = 0.5,
          .dropped_probability = 0.04,
          .cut_share = 0.03,
          .cut_dwell_s = 0.5,
          .duplicate_share = 0.04,
          .duplicate_dwell_s = 0.4,
          .swapped_share = 0.015,
          .swapped_dwell_s = 0.5,
          .zigzag_probability = 0.01,
          .ghost_rate_hz = {0.45, 2.5, 0.09},
          .intersection_ghost_rate_hz = 1.0,
          .occluder_rate_hz = 0.15,
          .style_unknown_probability = 0.1,
          .style_wrong_share = 0.08,
          .confidence = 0.8,
          .confidence_stddev = 0.12,
          .confidence_per_m = 0.004,
          .confidence_per_error_m = 0.3};
}

NoiseProfile av2() {
  NoiseProfile profile = inhouse();
  profile.name = "av2";
  profile.poor_share = 0.10;
  profile.error_factor = {1.03, 1.54, 0.95};
  profile.flutter_stddev_m = 0.002;
  profile.missed_share = {0.19, 0.34, 0.08};
  profile.cut_share = 0.08;
  profile.ghost_rate_hz = {0.7, 2.3, 0.1};
  return profile;
}

/// As by cameras that swing and clocks that differ: whole frames are turned and shifted.
NoiseProfile shaken() {
  NoiseProfile profile = inhouse();
  profile.name = "shaken";
  profile.frame_yaw_stddev_deg = 0.8;
  profile.frame_longitudinal_stddev_m = 0.4;
  profile.frame_memory_s = 0.3;
  return profile;
}

}  // namespace

std::vector<std::string> noise_profile_names() { return {"none", "inhouse", "av2", "shaken"}; }

NoiseProfile noise_profile(const std::string& name) {
  if (name == "none") return {};
  if (name == "inhouse") return inhouse();
  if (name == "av2") return av2();
  if (name == "shaken") return shaken();
  throw std::invalid_argument("unknown noise profile '" + name + "'; known are none, inhouse, av2, shaken");
}

}  // namespace laneloom
