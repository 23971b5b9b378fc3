#include "simulation/random_network.hpp"

#include <cmath>

#include "simulation/random.hpp"

namespace laneloom::simulation {
namespace {

/// Draws within bounds.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high) { return random_.uniform(low, high); }
  /// A number whose logarithm is uniform.
  double log_uniform(double low, double high) { return low * std::exp(uniform() * std::log(high / low)); }
  Defect defect(double low_share, double high_share, double high_lasting, double high_dwell_s) {
    Defect defect;
    defect.share = log_uniform(low_share, high_share);
    defect.lasting = uniform(0.0, high_lasting);
    defect.dwell_s = log_uniform(0.1, high_dwell_s);
    return defect;
  }

 private:
  double uniform() { return random_.uniform(); }
  Random random_;
};

void draw_lateral(NoiseProfile& noise, Draw& draw) {
  noise.offset_stddev_m = draw.log_uniform(0.02, 0.15);
  noise.offset_stddev_per_m = draw.log_uniform(0.0003, 0.004);
  noise.offset_stddev_far_m = draw.log_uniform(0.02, 0.3);
  noise.offset_lasting = draw.uniform(0.0, 0.9);
  noise.rotation_stddev_deg = draw.log_uniform(0.03, 0.3);
  noise.line_memory_s = draw.log_uniform(0.2, 10.0);
  for (double& factor : noise.error_factor) factor = draw.log_uniform(0.7, 1.5);
  noise.flutter_stddev_m = draw.log_uniform(0.005, 0.06);
  noise.point_stddev_m = draw.log_uniform(0.005, 0.03);
  noise.poor = draw.defect(0.02, 0.2, 0.9, 5.0);
  noise.poor_stddev_m = draw.log_uniform(0.2, 0.8);
  noise.poor_stddev_per_m = draw.log_uniform(0.003, 0.02);
  noise.end_swing_stddev_m = draw.log_uniform(0.05, 0.4);
  noise.end_shift_stddev_m = draw.log_uniform(0.2, 1.5);
  noise.end_memory_s = draw.log_uniform(0.2, 4.0);
}

void draw_frame(NoiseProfile& noise, Draw& draw) {
  noise.frame_yaw_stddev_deg = draw.log_uniform(0.03, 0.8);
  noise.frame_longitudinal_stddev_m = draw.log_uniform(0.05, 0.4);
  noise.frame_lateral_stddev_m = draw.log_uniform(0.01, 0.1);
  noise.frame_scale_stddev_per_m = draw.log_uniform(0.0001, 0.003);
  noise.frame_memory_s = draw.log_uniform(0.1, 2.0);
}

void draw_missed(NoiseProfile& noise, Draw& draw) {
  noise.missed_share[index(MarkingType::laneline)] = draw.uniform(0.02, 0.25);
  noise.missed_share[index(MarkingType::roadedge)] = draw.uniform(0.05, 0.35);
  noise.missed_share[index(MarkingType::stopline)] = draw.uniform(0.0, 0.15);
  for (double& lasting : noise.missed_lasting) lasting = draw.uniform(0.0, 0.9);
  noise.missed_share_per_m = draw.log_uniform(0.0005, 0.006);
  noise.missed_dwell_s = draw.log_uniform(0.2, 4.0);
  noise.dropped_probability = draw.uniform(0.0, 0.08);
  noise.occluder_rate_hz = draw.log_uniform(0.05, 0.4);
  noise.occluder_dwell_s = draw.log_uniform(1.0, 6.0);
}

void draw_lines(NoiseProfile& noise, Draw& draw) {
  noise.cut = draw.defect(0.01, 0.1, 0.5, 3.0);
  noise.cut_gap_m = draw.uniform(1.0, 5.0);
  noise.duplicate = draw.defect(0.01, 0.1, 0.9, 4.0);
  noise.duplicate_offset_m = draw.log_uniform(0.3, 0.9);
  noise.swapped = draw.defect(0.005, 0.05, 0.9, 2.0);
  noise.zigzag_probability = draw.log_uniform(0.003, 0.03);
  noise.style_unknown_probability = draw.uniform(0.0, 0.3);
  noise.style_wrong = draw.defect(0.02, 0.2, 0.6, 4.0);
}

void draw_ghosts(NoiseProfile& noise, Draw& draw) {
  noise.ghost_dwell_s = draw.log_uniform(0.1, 0.6);
  noise.ghost_lasting_share = draw.uniform(0.0, 0.6);
  noise.ghost_lasting_dwell_s = draw.log_uniform(1.0, 10.0);
  const double life_s = mean_ghost_life_s(noise);
  noise.ghost_rate_hz[index(MarkingType::laneline)] = draw.log_uniform(0.1, 0.6) / life_s;
  noise.ghost_rate_hz[index(MarkingType::roadedge)] = draw.log_uniform(0.2, 1.5) / life_s;
  noise.ghost_rate_hz[index(MarkingType::stopline)] = draw.log_uniform(0.02, 0.1) / life_s;
  noise.intersection_ghost_rate_hz = draw.log_uniform(0.1, 0.8) / life_s;
  noise.ghost_beside_share = draw.uniform(0.2, 0.8);
  noise.ghost_jitter_m = draw.log_uniform(0.02, 0.3);
}

void draw_confidences(NoiseProfile& noise, Draw& draw) {
  noise.confidence = draw.uniform(0.65, 0.9);
  noise.confidence_per_m = draw.log_uniform(0.001, 0.008);
  noise.confidence_per_error_m = draw.uniform(0.1, 0.5);
  noise.ghost_confidence = noise.confidence - draw.uniform(0.02, 0.4);
  noise.confidence_stddev = draw.log_uniform(0.05, 0.2);
  noise.confidence_held = draw.uniform(0.0, 1.0);
  noise.confidence_memory_s = draw.log_uniform(0.3, 10.0);
  noise.frame_confidence_stddev = draw.log_uniform(0.01, 0.08);
}

}  // namespace

NoiseProfile random_network(std::uint64_t seed) {
  NoiseProfile noise;
  noise.name = "random:" + std::to_string(seed);
  Draw draw(seed);
  draw_lateral(noise, draw);
  draw_frame(noise, draw);
  draw_missed(noise, draw);
  draw_lines(noise, draw);
  draw_ghosts(noise, draw);
  draw_confidences(noise, draw);
  noise.tells_view = seed % 2 == 0;
  return noise;
}

}  // namespace laneloom::simulation
