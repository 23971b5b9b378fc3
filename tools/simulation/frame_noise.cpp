#include "simulation/frame_noise.hpp"

#include <algorithm>
#include <numbers>

namespace laneloom::simulation {

FrameNoise::FrameNoise(Random& random)
    : yaw_(random), pitch_(random), longitudinal_(random), lateral_(random), glare_(random) {}

void FrameNoise::step(double dt_s, const NoiseProfile& noise, Random& random) {
  for (Wander* wander : {&yaw_, &pitch_, &longitudinal_, &lateral_})
    wander->step(dt_s, noise.frame_memory_s, random);
  glare_.step(dt_s, noise.confidence_memory_s, random);
  const auto turn = [](double angle_deg, const Point& axis) {
    return Eigen::AngleAxisd(angle_deg * std::numbers::pi / 180.0, axis);
  };
  T_seen_body_ = Eigen::Translation3d(longitudinal_.value() * noise.frame_longitudinal_stddev_m,
                                      lateral_.value() * noise.frame_lateral_stddev_m, 0.0) *
                 turn(yaw_.value() * noise.frame_yaw_stddev_deg, Point::UnitZ()) *
                 turn(pitch_.value() * noise.frame_pitch_stddev_deg, Point::UnitY());
  scale_per_m_ = pitch_.value() * noise.frame_scale_stddev_per_m;
  confidence_ = glare_.value() * noise.frame_confidence_stddev;
}

Point FrameNoise::seen(const Point& point) const {
  // A network that takes the ground for flat puts points farther away and wider apart, the farther they are;
  // behind the vehicle it puts them nearer.
  constexpr double kMaxScale = 0.5;
  Point scaled = point;
  scaled.head<2>() *= 1.0 + std::clamp(scale_per_m_ * point.x(), -kMaxScale, kMaxScale);
  return T_seen_body_ * scaled;
}

}  // namespace laneloom::simulation
