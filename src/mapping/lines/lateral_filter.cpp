#include "mapping/lines/lateral_filter.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/geometry/reproducible.hpp"
#include "mapping/lines/network_model.hpp"

namespace laneloom {
namespace {

constexpr double kShared = NetworkModel::kShared;
constexpr double kDrift_m2_per_m = 1e-4;  // of the poses: keeps a station able to move

}  // namespace

LateralFilter::LateralFilter(const LateralView& first)
    : seen_from_(first.seen_from), stddev_m_(first.stddev_m) {
  const double variance_m2 = first.stddev_m * first.stddev_m, shared_m2 = kShared * variance_m2;
  covariance_ << variance_m2, -shared_m2, -shared_m2, shared_m2;
}

void LateralFilter::predict(const LateralView& view) {
  const double driven_m = (view.seen_from - seen_from_).norm();
  // Of the error of a better view the worse one before had its share, and one of its own. It does not shrink
  // in proportion: the filter would go on beyond what was seen, as the views have moved so far.
  const double ratio = stddev_m_ > 0.0 ? std::min(1.0, view.stddev_m / stddev_m_) : 1.0;
  const double kept = reproducible::exp(-driven_m / view.correlation_m) * ratio;
  error_m_ *= kept;
  covariance_.row(1) *= kept;
  covariance_.col(1) *= kept;
  covariance_(0, 0) += kDrift_m2_per_m * driven_m;
  covariance_(1, 1) += kShared * (view.stddev_m * view.stddev_m - kept * kept * stddev_m_ * stddev_m_);
  seen_from_ = view.seen_from;
  stddev_m_ = view.stddev_m;
}

double LateralFilter::update(const LateralView& view) {
  predict(view);
  const double noise_m2 = (1.0 - kShared) * view.stddev_m * view.stddev_m;
  const Eigen::Vector2d covariance = covariance_.rowwise().sum();  // with what is seen: place and error
  Eigen::Vector2d gain = covariance / (covariance.sum() + noise_m2);
  gain.x() = std::clamp(gain.x(), 0.0, 1.0);
  const Eigen::Matrix2d rest = Eigen::Matrix2d::Identity() - gain * Eigen::RowVector2d::Ones();
  covariance_ = rest * covariance_ * rest.transpose() + noise_m2 * gain * gain.transpose();
  const double surprise_m = view.lateral_m - error_m_;
  error_m_ += gain.y() * surprise_m;
  return gain.x() * surprise_m;
}

}  // namespace laneloom
