#pragma once

#include <Eigen/Geometry>
#include <cstdint>

namespace laneloom::lines {

/// One view of a place on a line.
struct LateralView {
  double lateral_m = 0.0;  ///< of the view, left of the place as it is known so far
  double stddev_m = 0.0;   ///< of the view
  Eigen::Vector2d seen_from = Eigen::Vector2d::Zero();  ///< place of the vehicle, map frame
  std::int64_t stamp_ns = 0;                            ///< of the frame
};

/// Estimates the lateral place of a station. It is a Kalman filter of two states: the place itself and the
/// error that the network makes about it at the moment. Thereby several views from nearby places count little
/// more than one of them. The views of a standing vehicle count less still, but an error does not last for as
/// long as the vehicle stands: what is seen for seconds from near moves a place that was learned from far.
class LateralFilter {
 public:
  /// The state after the first view.
  explicit LateralFilter(const LateralView& first = {});

  /// Takes in another view. Returns how far to the left the place moves.
  double update(const LateralView& view);

  /// Moves the place that the last view was seen from, map frame. A motion of the map about the vertical.
  void move(const Eigen::Isometry3d& motion) {
    seen_from_ = motion.linear().topLeftCorner<2, 2>() * seen_from_ + motion.translation().head<2>();
  }

  /// Lets left be right, for a line that runs the other way.
  void mirror() { error_m_ = -error_m_; }

  double variance_m2() const { return covariance_(0, 0); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(error_m_, covariance_, seen_from_, stamp_ns_, stddev_m_);
  }

 private:
  void predict(const LateralView& view);

  double error_m_ = 0.0;        ///< present error of the network
  Eigen::Matrix2d covariance_;  ///< of the place and the network's error
  Eigen::Vector2d seen_from_;   ///< where the last view was seen from
  std::int64_t stamp_ns_;       ///< of the newest view
  double stddev_m_;             ///< of the last view
};

}  // namespace laneloom::lines
