#include "mapping/lines/lateral_filter.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/geometry/reproducible.hpp"

namespace laneloom::lines {
namespace {

constexpr double kShared = 0.9;  // of a view's variance fades with the distance driven; the rest is new
constexpr double kCorrelation_m = 5.0;      // distance driven over which that share falls to 1/e
constexpr double kPassing_m_per_ns = 6e-9;  // errors change with time as if no vehicle drove below 6 m/s
constexpr double kDrift_m2_per_m = 1.5e-3;  // of the poses: 0.12 m after 10 m; what is seen last decides

}  // namespace

LateralFilter::LateralFilter(const LateralView& first)
    : seen_from_(first.seen_from), stamp_ns_(first.stamp_ns), stddev_m_(first.stddev_m) {
  const double variance_m2 = first.stddev_m * first.stddev_m, shared_m2 = kShared * variance_m2;
  covariance_ << variance_m2, -shared_m2, -shared_m2, shared_m2;
}

void LateralFilter::predict(const LateralView& view) {
  const double driven_m = (view.seen_from - seen_from_).norm();
  // The frames of several sources do not come in the order of their stamps.
  const std::int64_t passed_ns = std::max<std::int64_t>(0, view.stamp_ns - stamp_ns_);
  const double changed_m = std::max(driven_m, kPassing_m_per_ns * static_cast<double>(passed_ns));
  // A better view than the one before has its error, scaled down to the deviation of the better view. A worse
  // view has the error of the one before and a further one of its own, so that nothing is scaled up.
  const double ratio = stddev_m_ > 0.0 ? std::min(1.0, view.stddev_m / stddev_m_) : 1.0;
  const double kept = geometry::reproducible::exp(-changed_m / kCorrelation_m) * ratio;
  error_m_ *= kept;
  covariance_.row(1) *= kept;
  covariance_.col(1) *= kept;
  covariance_(0, 0) += kDrift_m2_per_m * driven_m;
  covariance_(1, 1) += kShared * (view.stddev_m * view.stddev_m - kept * kept * stddev_m_ * stddev_m_);
  seen_from_ = view.seen_from;
  stamp_ns_ = std::max(stamp_ns_, view.stamp_ns);
  stddev_m_ = view.stddev_m;
}

double LateralFilter::update(const LateralView& view) {
  predict(view);
  const double noise_m2 = (1.0 - kShared) * view.stddev_m * view.stddev_m;
  const Eigen::Vector2d covariance = covariance_.rowwise().sum();  // of place and error with the view
  Eigen::Vector2d gain = covariance / (covariance.sum() + noise_m2);
  // Without the limit, a place would move beyond a view that is much better than the one before.
  gain.x() = std::clamp(gain.x(), 0.0, 1.0);
  const Eigen::Matrix2d rest = Eigen::Matrix2d::Identity() - gain * Eigen::RowVector2d::Ones();
  covariance_ = rest * covariance_ * rest.transpose() + noise_m2 * gain * gain.transpose();
  const double surprise_m = view.lateral_m - error_m_;
  error_m_ += gain.y() * surprise_m;
  return gain.x() * surprise_m;
}

}  // namespace laneloom::lines
