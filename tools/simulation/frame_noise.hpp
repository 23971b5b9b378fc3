#pragma once

#include <Eigen/Geometry>

#include "simulation/noise_profile.hpp"
#include "simulation/random.hpp"

namespace laneloom::simulation {

/// The errors of a frame as a whole.
class FrameNoise {
 public:
  explicit FrameNoise(Random& random);
  void step(double dt_s, const NoiseProfile& noise, Random& random);

  /// The place at which a network sees a point of the body frame.
  Point seen(const Point& point) const;
  /// The error that is added to every confidence.
  double confidence() const { return confidence_; }

 private:
  Wander yaw_, pitch_, longitudinal_, lateral_, glare_;
  Eigen::Isometry3d T_seen_body_ = Eigen::Isometry3d::Identity();
  double scale_per_m_ = 0.0;
  double confidence_ = 0.0;
};

}  // namespace laneloom::simulation
