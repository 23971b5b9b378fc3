#include "mapping/lines/lateral_filter.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/lines/network_model.hpp"

namespace laneloom {
namespace {

constexpr double kShared = NetworkModel::kShared;
constexpr double kDrift_m2_per_m = 1e-4;  // of the poses: keeps a station able to move

}  // namespace

LateralFilter::LateralFilter(const LateralView& first) : seen_from_(first.seen_from) {
  const double shared_m = std::sqrt(kShared) * first.stddev_m;
  covariance_ << first.stddev_m * first.stddev_m, -shared_m, -shared_m, 1.0;
}

double LateralFilter::update(const LateralView& view) {
  const double driven_m = (view.seen_from - seen_from_).norm();
  seen_from_ = view.seen_from;
  const Eigen::Vector2d kept(1.0, std::exp(-driven_m / view.correlation_m));
  error_ *= kept.y();
  covariance_ = kept.asDiagonal() * covariance_ * kept.asDiagonal();
  covariance_.diagonal() += Eigen::Vector2d(kDrift_m2_per_m * driven_m, 1.0 - kept.y() * kept.y());

  const Eigen::RowVector2d model(1.0, std::sqrt(kShared) * view.stddev_m);
  const double noise_m2 = (1.0 - kShared) * view.stddev_m * view.stddev_m;
  const Eigen::Vector2d covariance = covariance_ * model.transpose();
  const double surprise_m = view.lateral_m - model.y() * error_;
  Eigen::Vector2d gain = covariance / (model * covariance + noise_m2);
  // It would extrapolate beyond a view that is much better than the one before.
  gain.x() = std::clamp(gain.x(), 0.0, 1.0);
  const Eigen::Matrix2d rest = Eigen::Matrix2d::Identity() - gain * model;
  covariance_ = rest * covariance_ * rest.transpose() + noise_m2 * gain * gain.transpose();
  error_ += gain.y() * surprise_m;
  return gain.x() * surprise_m;
}

}  // namespace laneloom
