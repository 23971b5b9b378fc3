#include "simulation/noise_profile.hpp"

#include <charconv>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "simulation/random_network.hpp"

namespace laneloom::simulation {
namespace {

// Missed shares, ghost rates, error factors and flutter come from `laneloom-lab calibrate`, which fits them
// to the paper's MapTR rows; the rest was chosen by what the paper's method then makes of it (README.md).
NoiseProfile inhouse() {
  return {.name = "inhouse",
          .offset_stddev_m = 0.10,
          .offset_stddev_per_m = 0.001,
          .offset_stddev_far_m = 0.04,
          .offset_lasting = 0.9,
          .rotation_stddev_deg = 0.05,
          .line_memory_s = 1.0,
          .error_factor = {1.61, 1.49, 1.48},
          .flutter_stddev_m = 0.011,
          .point_stddev_m = 0.01,
          .poor = {.share = 0.2, .lasting = 0.0, .dwell_s = 0.15},
          .poor_stddev_m = 0.4,
          .poor_stddev_per_m = 0.01,
          .end_swing_stddev_m = 0.08,
          .end_shift_stddev_m = 0.8,
          .end_memory_s = 1.5,
          .frame_yaw_stddev_deg = 0.04,
          .frame_longitudinal_stddev_m = 0.04,
          .frame_lateral_stddev_m = 0.02,
          .frame_scale_stddev_per_m = 0.0001,
          .frame_memory_s = 1.0,
          .missed_share = {0.03, 0.06, 0.10},
          .missed_lasting = {0.95, 0.95, 0.9},
          .missed_share_per_m = 0.002,
          .missed_dwell_s = 0.5,
          .dropped_probability = 0.04,
          .cut = {.share = 0.02, .lasting = 0.2, .dwell_s = 0.5},
          .duplicate = {.share = 0.02, .lasting = 0.2, .dwell_s = 0.4},
          .swapped = {.share = 0.015, .lasting = 0.3, .dwell_s = 0.5},
          .zigzag_probability = 0.01,
          .ghost_rate_hz = {0.0, 0.75, 0.03},
          .intersection_ghost_rate_hz = 0.3,
          .ghost_beside_share = 0.5,
          .ghost_dwell_s = 0.3,
          .ghost_lasting_share = 0.05,
          .ghost_lasting_dwell_s = 3.0,
          .ghost_jitter_m = 0.1,
          .occluder_rate_hz = 0.15,
          .style_unknown_probability = 0.1,
          .style_wrong = {.share = 0.08, .lasting = 0.3, .dwell_s = 1.0},
          .confidence = 0.8,
          .confidence_per_m = 0.004,
          .confidence_per_error_m = 0.3,
          .ghost_confidence = 0.55,
          .confidence_stddev = 0.12,
          .confidence_held = 0.5,
          .confidence_memory_s = 2.0,
          .frame_confidence_stddev = 0.02};
}

NoiseProfile av2() {
  NoiseProfile profile = inhouse();
  profile.name = "av2";
  profile.offset_stddev_far_m = 0.08;
  profile.line_memory_s = 3.0;
  profile.rotation_stddev_deg = 0.1;
  profile.error_factor = {0.97, 1.52, 0.95};
  profile.flutter_stddev_m = 0.001;
  profile.poor = {.share = 0.10, .lasting = 0.9, .dwell_s = 3.0};
  profile.end_swing_stddev_m = 0.15;
  profile.frame_yaw_stddev_deg = 0.1;
  profile.frame_longitudinal_stddev_m = 0.1;
  profile.frame_scale_stddev_per_m = 0.0005;
  profile.missed_share = {0.28, 0.21, 0.08};
  profile.missed_lasting = {0.5, 0.95, 0.7};
  profile.missed_dwell_s = 2.0;
  profile.cut = {.share = 0.03, .lasting = 0.5, .dwell_s = 2.0};
  profile.duplicate = {.share = 0.03, .lasting = 0.6, .dwell_s = 2.0};
  profile.ghost_rate_hz = {0.23, 0.0, 0.1};
  profile.intersection_ghost_rate_hz = 0.02;
  profile.ghost_lasting_share = 0.7;
  profile.ghost_lasting_dwell_s = 8.0;
  profile.ghost_jitter_m = 0.03;
  return profile;
}

/// Whole frames are turned, scaled and shifted, as by cameras that swing and clocks that differ.
NoiseProfile shaken() {
  NoiseProfile profile = inhouse();
  profile.name = "shaken";
  profile.frame_yaw_stddev_deg = 0.8;
  profile.frame_longitudinal_stddev_m = 0.4;
  profile.frame_pitch_stddev_deg = 0.2;
  profile.frame_scale_stddev_per_m = 0.002;
  profile.frame_memory_s = 0.3;
  return profile;
}

std::optional<std::uint64_t> seed_of_random(const std::string& name) {
  constexpr std::string_view kPrefix = "random:";
  if (!name.starts_with(kPrefix)) return std::nullopt;
  std::uint64_t seed = 0;
  const char* end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data() + kPrefix.size(), end, seed);
  if (error != std::errc() || rest != end) return std::nullopt;
  return seed;
}

}  // namespace

double mean_ghost_life_s(const NoiseProfile& noise) {
  return (1.0 - noise.ghost_lasting_share) * noise.ghost_dwell_s +
         noise.ghost_lasting_share * noise.ghost_lasting_dwell_s;
}

std::vector<std::string> noise_profile_names() { return {"none", "inhouse", "av2", "shaken"}; }

NoiseProfile noise_profile(const std::string& name) {
  if (name == "none") return {};
  if (name == "inhouse") return inhouse();
  if (name == "av2") return av2();
  if (name == "shaken") return shaken();
  if (const auto seed = seed_of_random(name)) return random_network(*seed);
  throw std::invalid_argument("unknown noise profile '" + name +
                              "'; known are none, inhouse, av2, shaken, random:SEED");
}

}  // namespace laneloom::simulation
