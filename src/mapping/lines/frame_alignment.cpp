#include "mapping/lines/frame_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/degree.hpp"
#include "mapping/geometry/left_of.hpp"

namespace laneloom::lines {
namespace {

constexpr double kNewShare = 0.02;     // weight of a new frame in the lasting error: 5 s at 10 Hz
constexpr double kLineStddev_m = 0.2;  // error that all samples of one line have in common
constexpr double kOutlier_m = 0.15;    // lateral; a line that is further off weighs little
constexpr int kRounds = 3;             // each weighs the lines anew
constexpr std::size_t kStride = 4;     // only every so many-th sample is used
const FrameError kExpected{0.3, 0.03, 0.6 * kDegree};  // standard deviations before a frame is seen
const FrameError kAway{0.3, 0.3, 1.0 * kDegree};       // likewise, of poses that come away from the map
const FrameError kLimit{0.5, 0.3, 2.0 * kDegree};

/// The equation of one sample: lateral_m = row * error.
struct Equation {
  Eigen::RowVector3d row;
  double lateral_m;
};

Eigen::Matrix2d heading_of(const Eigen::Isometry3d& T_map_body) {
  const Eigen::Vector2d ahead = T_map_body.linear().col(0).head<2>().normalized();
  return (Eigen::Matrix2d() << ahead.x(), -ahead.y(), ahead.y(), ahead.x()).finished();
}

std::size_t station_of(const SampleMatch& match, const Line& line) {
  const auto last = static_cast<double>(line.stations.size() - 1);
  return nearest_station(std::clamp(match.foot.index, 0.0, last));
}

std::vector<Equation> equations(const LineMatch& match, const SampledDetection& detection, const Line& line,
                                const Eigen::Isometry3d& T_map_body, double min_log_odds) {
  const Eigen::Matrix2d R_map_body = heading_of(T_map_body);
  std::vector<Equation> rows;
  rows.reserve(match.samples.size());
  for (const SampleMatch& sample : match.samples) {
    const std::size_t k = station_of(sample, line);
    if (!sample.foot.inside || line.stations[k].log_odds < min_log_odds) continue;
    const Eigen::Vector2d along = R_map_body.transpose() * direction_at(line, k);
    const Eigen::Vector2d normal = geometry::left_of(along);
    const Point& point = detection.samples[sample.sample];
    const Eigen::Vector2d arm = R_map_body.transpose() * (point - T_map_body.translation()).head<2>();
    rows.push_back(
        {{normal.x(), normal.y(), arm.x() * normal.y() - arm.y() * normal.x()}, sample.foot.lateral_m});
  }
  return rows;
}

double mean_residual_m(const std::vector<Equation>& rows, const FrameError& error) {
  double sum_m = 0.0;
  for (const Equation& equation : rows) sum_m += equation.lateral_m - equation.row * error;
  return sum_m / static_cast<double>(rows.size());
}

/// The most likely error. `expected` are its standard deviations before the frame is seen.
FrameError solved(const std::vector<std::vector<Equation>>& by_line, const FrameError& expected) {
  FrameError error = FrameError::Zero();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d information = expected.array().square().inverse().matrix().asDiagonal();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& rows : by_line) {
      const double misfit = mean_residual_m(rows, error) / kOutlier_m;
      const double weight = 1.0 / (kLineStddev_m * kLineStddev_m * (1.0 + misfit * misfit));
      for (const auto& [row, lateral_m] : rows) {
        information += weight / static_cast<double>(rows.size()) * row.transpose() * row;
        sum += weight / static_cast<double>(rows.size()) * lateral_m * row.transpose();
      }
    }
    error = information.ldlt().solve(sum);
  }
  return error;
}

}  // namespace

FrameErrors estimate_errors(const std::vector<LineMatch>& matches,
                            const std::vector<SampledDetection>& detections, const std::vector<Line>& lines,
                            const Eigen::Isometry3d& T_map_body, double min_log_odds) {
  std::vector<std::vector<Equation>> by_line;
  by_line.reserve(matches.size());
  for (const LineMatch& match : matches) {
    auto rows = equations(match, detections[match.detection], lines[match.line], T_map_body, min_log_odds);
    if (!rows.empty()) by_line.push_back(std::move(rows));
  }
  return {solved(by_line, kExpected), solved(by_line, kAway)};
}

Eigen::Vector2d shifted_by(const FrameError& error, const Point& point, const Eigen::Isometry3d& T_map_body) {
  const Eigen::Vector2d arm = (point - T_map_body.translation()).head<2>();
  return heading_of(T_map_body) * error.head<2>() + error.z() * geometry::left_of(arm);
}

FrameErrors align_frame(const Eigen::Isometry3d& T_map_body, double gain, LineMatcher& matcher,
                        std::vector<SampledDetection>& detections, FrameError& lasting) {
  const auto [error, away] = estimate_errors(matcher.match(detections, kStride), detections, matcher.lines(),
                                             T_map_body, matcher.config().confirm_log_odds);
  FrameError passing = (error - lasting).cwiseMin(kLimit).cwiseMax(-kLimit);
  lasting += kNewShare * (error - lasting);
  for (SampledDetection& detection : detections)
    for (Point& point : detection.samples) point.head<2>() -= shifted_by(gain * passing, point, T_map_body);
  return {passing, away};
}

}  // namespace laneloom::lines
