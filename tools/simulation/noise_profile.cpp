#include "simulation/noise_profile.hpp"

#include <stdexcept>

namespace laneloom {
namespace {

// Lateral errors as real networks were seen to have: median and 90 % 0.09 and 0.43 m at 0-10 m, 0.13 and 0.65
// m at 10-20 m, 0.16 and 0.86 m at 20-30 m. The tail is why some lines are poor.
NoiseProfile inhouse() {
  return {.name = "inhouse",
          .offset_stddev_m = 0.07,
          .offset_stddev_per_m = 0.003,
          .rotation_stddev_deg = 0.3,
          .line_memory_s = 6.0,
          .poor_share = 0.17,
          .poor_dwell_s = 0.2,
          .poor_factor = 3.0,
          .end_swing_stddev_m = 0.15,
          .end_shift_stddev_m = 0.8,
          .end_memory_s = 1.5,
          .point_stddev_m = 0.01,
          .frame_yaw_stddev_deg = 0.1,
          .frame_pitch_stddev_deg = 0.2,
          .frame_longitudinal_stddev_m = 0.1,
          .frame_memory_s = 1.0,
          .missed_share = {0.05, 0.09, 0.03},
          .missed_share_per_m = 0.003,
          .missed_dwell_s = 0.5,
          .dropped_probability = 0.06,
          .cut_share = 0.06,
          .cut_dwell_s = 0.5,
          .duplicate_share = 0.05,
          .duplicate_dwell_s = 0.4,
          .swapped_share = 0.03,
          .swapped_dwell_s = 0.5,
          .zigzag_probability = 0.01,
          .ghost_rate_hz = 0.7,
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
  profile.missed_share = {0.10, 0.21, 0.08};
  profile.cut_share = 0.10;
  profile.poor_share = 0.19;
  profile.ghost_rate_hz = 0.9;
  profile.intersection_ghost_rate_hz = 1.2;
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
