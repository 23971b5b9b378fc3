#include "simulation/noise_profile.hpp"

#include <stdexcept>

namespace laneloom {
namespace {

// Missed shares, ghost rates, error factors and flutter come from `laneloom calibrate` (README), which fits them
// to the paper's MapTR rows. The rest was chosen after what real networks were seen to do: lateral errors of
// median and 90 % 0.09 and 0.43 m at 0-10 m, 0.13 and 0.65 m at 10-20 m, 0.16 and 0.86 m at 20-30 m, that last
// as long as a line is seen; ends that swing, near-duplicates, swapped classes.
NoiseProfile inhouse() {
  return {.name = "inhouse",
          .offset_stddev_m = 0.07,
          .offset_stddev_per_m = 0.003,
          .rotation_stddev_deg = 0.3,
          .line_memory_s = 30.0,
          .poor_share = 0.04,
          .poor_dwell_s = 0.2,
          .poor_factor = 3.0,
          .error_factor = {1.72, 1.38, 0.87},
          .flutter_stddev_m = 0.044,
          .end_swing_stddev_m = 0.15,
          .end_shift_stddev_m = 0.8,
          .end_memory_s = 1.5,
          .point_stddev_m = 0.01,
          .frame_yaw_stddev_deg = 0.1,
          .frame_pitch_stddev_deg = 0.2,
          .frame_longitudinal_stddev_m = 0.1,
          .frame_memory_s = 1.0,
          .missed_share = {0.03, 0.13, 0.0},
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
          .ghost_rate_hz = {0.06, 2.2, 0.13},
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
  profile.poor_dwell_s = 0.8;
  profile.poor_share = 0.10;
  profile.error_factor = {0.97, 1.77, 0.86};
  profile.flutter_stddev_m = 0.005;
  profile.missed_share = {0.19, 0.30, 0.08};
  profile.cut_share = 0.08;
  profile.ghost_rate_hz = {0.6, 1.8, 0.1};
  return profile;
}

}  // namespace

std::vector<std::string> noise_profile_names() { return {"none", "inhouse", "av2"}; }

NoiseProfile noise_profile(const std::string& name) {
  if (name == "none") return {};
  if (name == "inhouse") return inhouse();
  if (name == "av2") return av2();
  throw std::invalid_argument("unknown noise profile '" + name + "'; known are none, inhouse, av2");
}

}  // namespace laneloom
