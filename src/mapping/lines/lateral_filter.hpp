#pragma once

#include <Eigen/Core>

namespace laneloom {

/// One view of a place on a line.
struct LateralView {
  double lateral_m = 0.0;  ///< left of the place as it is known so far
  double stddev_m = 0.0;
  double correlation_m = 1.0;  ///< driven, over which the network's error becomes another one
  Eigen::Vector2d seen_from = Eigen::Vector2d::Zero();  ///< map frame
};

/// How well the lateral place of a station is known: a Kalman filter of two states, the place itself and the
/// error that the network makes about it at the moment. So views from places that are near each other count
/// little more than one of them, and the views of a standing vehicle hardly at all.
class LateralFilter {
 public:
  /// After the first view.
  explicit LateralFilter(const LateralView& first = {});

  /// Takes in another view. Returns how far to the left the place moves.
  double update(const LateralView& view);

  double variance_m2() const { return covariance_(0, 0); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(error_m_, covariance_, seen_from_, stddev_m_);
  }

 private:
  void predict(const LateralView& view);

  double error_m_ = 0.0;        ///< of the network
  Eigen::Matrix2d covariance_;  ///< of the place and of that error
  Eigen::Vector2d seen_from_;   ///< of the last view
  double stddev_m_;             ///< likewise
};

}  // namespace laneloom
