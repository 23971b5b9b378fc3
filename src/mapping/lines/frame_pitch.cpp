#include "mapping/lines/frame_pitch.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace laneloom::lines {
namespace {

constexpr double kFurthest_m = 60.0;       // ahead; further samples are left out
constexpr double kMinLength_m = 8.0;       // shorter lines are left out
constexpr double kMaxSlope = 0.5;          // lines that run more across are left out
constexpr double kExpected_per_m = 0.006;  // standard deviation of the stretch
constexpr double kLimit_per_m = 0.012;
constexpr double kStddevPer_m2 = 0.0003;  // of a sample, by the square of its distance
constexpr double kStddev_m = 0.03;
constexpr double kCorrelated = 8.0;  // number of neighbouring samples that err alike
constexpr double kOutlier = 2.0;     // in deviations; a sample that is further off weighs little
constexpr int kFits = 4;

/// A place of a line in the body frame.
struct Place {
  double x_m, y_m;
};

/// A line that runs ahead.
struct LineAhead {
  std::vector<Place> places;
  double offset_m = 0.0;  ///< to the left of the course that all lines have in common

  bool says_something() const {
    if (places.empty()) return false;
    const double length_m = std::abs(places.back().x_m - places.front().x_m);
    return length_m >= kMinLength_m &&
           std::abs(places.back().y_m - places.front().y_m) <= kMaxSlope * length_m;
  }
};

std::vector<LineAhead> lines_ahead(const std::vector<SampledDetection>& detections,
                                   const Eigen::Isometry3d& T_map_body) {
  const Eigen::Isometry3d T_body_map = T_map_body.inverse();
  std::vector<LineAhead> lines;
  for (const SampledDetection& detection : detections) {
    if (is_stopline(detection.type)) continue;
    LineAhead line;
    line.places.reserve(detection.samples.size());
    for (const Point& sample : detection.samples) {
      const Point place = T_body_map * sample;
      if (place.x() >= 0.0 && place.x() <= kFurthest_m) line.places.push_back({place.x(), place.y()});
    }
    if (line.says_something()) lines.push_back(std::move(line));
  }
  return lines;
}

/// The unknowns that all lines have in common: the stretch, and the coefficients of a cubic course in units
/// of 10 m.
using Common = Eigen::Vector4d;

/// The normal equations of one line at an estimate, for the common unknowns and the line's own offset.
struct Equations {
  Eigen::Matrix4d common = Eigen::Matrix4d::Zero();
  Common cross = Common::Zero();
  double own = 0.0;
  Common common_sum = Common::Zero();
  double own_sum = 0.0;
};

Equations equations(const LineAhead& line, const Common& estimate, bool robust) {
  Equations result;
  for (const Place& place : line.places) {
    const double ahead_m = place.x_m - kPitchPivot_m, u = 0.1 * place.x_m;
    const double stretch = 1.0 + estimate(0) * ahead_m;
    const Common row(ahead_m * line.offset_m, u, u * u, u * u * u);
    const double rest_m = place.y_m - line.offset_m * stretch - row.tail<3>().dot(estimate.tail<3>());
    const double stddev_m = kStddev_m + kStddevPer_m2 * place.x_m * place.x_m;
    const double misfit = robust ? rest_m / (kOutlier * stddev_m) : 0.0;
    const double weight = 1.0 / (kCorrelated * stddev_m * stddev_m * (1.0 + misfit * misfit));
    result.common += weight * row * row.transpose();
    result.cross += weight * stretch * row;
    result.own += weight * stretch * stretch;
    result.common_sum += weight * rest_m * row;
    result.own_sum += weight * rest_m * stretch;
  }
  return result;
}

}  // namespace

// Gauss-Newton for y = c (1 + k (x - pivot)) + a x + b x^2 + d x^3, with an offset c of each line, which is
// eliminated.
double estimate_stretch_per_m(const std::vector<SampledDetection>& detections,
                              const Eigen::Isometry3d& T_map_body) {
  std::vector<LineAhead> lines = lines_ahead(detections, T_map_body);
  if (lines.size() < 2) return 0.0;
  Common estimate = Common::Zero();
  std::vector<Equations> all(lines.size());
  for (int round = 0; round < kFits; ++round) {
    Eigen::Matrix4d information = 1e-9 * Eigen::Matrix4d::Identity();
    information(0, 0) += 1.0 / (kExpected_per_m * kExpected_per_m);
    Common sum(-information(0, 0) * estimate(0), 0.0, 0.0, 0.0);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Equations& e = all[i] = equations(lines[i], estimate, round > 0);
      information += e.common - e.cross * e.cross.transpose() / e.own;
      sum += e.common_sum - e.cross * (e.own_sum / e.own);
    }
    const Common step = information.ldlt().solve(sum);
    estimate += step;
    for (std::size_t i = 0; i < lines.size(); ++i)
      lines[i].offset_m += (all[i].own_sum - all[i].cross.dot(step)) / all[i].own;
  }
  return std::clamp(estimate(0), -kLimit_per_m, kLimit_per_m);
}

Eigen::Vector2d stretched_by(double stretch_per_m, const Point& point, const Eigen::Isometry3d& T_map_body) {
  const Eigen::Vector2d arm = (point - T_map_body.translation()).head<2>();
  const double ahead_m = arm.dot(T_map_body.linear().col(0).head<2>().normalized()) - kPitchPivot_m;
  if (ahead_m <= 0.0) return Eigen::Vector2d::Zero();
  // The fit says nothing beyond: a place that far would be thrown beyond the horizon.
  const double stretch = stretch_per_m * std::min(ahead_m, kFurthest_m - kPitchPivot_m);
  return stretch / (1.0 + stretch) * arm;
}

void unstretch(double stretch_per_m, const Eigen::Isometry3d& T_map_body,
               std::vector<SampledDetection>& detections) {
  for (SampledDetection& detection : detections)
    for (Point& sample : detection.samples)
      sample.head<2>() -= stretched_by(stretch_per_m, sample, T_map_body);
}

}  // namespace laneloom::lines
