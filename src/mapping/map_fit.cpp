#include "mapping/map_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/degree.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/geometry/left_of.hpp"
#include "mapping/geometry/levels.hpp"

namespace laneloom {
namespace {

constexpr double kStep_m = 1.0;  // between the places of a marking
constexpr double kMostSamples =
    400;  // of a frame's detections; longer steps lie between those of a longer frame
constexpr double kFurthest_m = 50.0;  // from the vehicle; what is further is left out
constexpr double kGate_m = 0.6;       // lateral: what is further beside a marking does not lie on it
constexpr double kReach_m = 1.0;      // likewise while a pose is refined
constexpr double kMaxAngle_deg = 25.0;

constexpr int kRounds = 5;
constexpr double kOutlier_m = 0.2;      // lateral; a sample that is further off weighs little
constexpr double kStddev_m = 0.2;       // lateral, of a sample
constexpr double kCorrelated_m = 60.0;  // so many metres of detections, of one or more lines, err alike
// Standard deviations of a pose that is refined: ahead, to the left, and its heading in rad.
const Eigen::Vector3d kExpected{0.5, 0.15, 1.5 * kDegree};

/// A small motion of the vehicle in its own frame: metres ahead and to the left, and the turn in rad.
Eigen::Isometry3d moved(const Eigen::Vector3d& step) {
  const Eigen::Vector2d ahead = Eigen::Vector2d(1.0, step.z()).normalized();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear().topLeftCorner<2, 2>() << ahead.x(), -ahead.y(), ahead.y(), ahead.x();
  motion.translation().head<2>() = step.head<2>();
  return motion;
}

}  // namespace

MapFit::MapFit(const DetectionFrame& frame, const std::vector<Marking>& markings,
               const Eigen::Isometry3d& near) {
  double length_m = 0.0;
  for (const Detection& detection : frame.detections) length_m += length(detection.points);
  step_m_ = std::max(kStep_m, length_m / kMostSamples);
  for (const Detection& detection : frame.detections)
    std::ranges::copy_if(places(detection.points, detection.type, step_m_), std::back_inserter(samples_),
                         [](const Place& sample) { return sample.position.head<2>().norm() <= kFurthest_m; });
  std::vector<Place> all;
  for (const Marking& marking : markings)
    std::ranges::copy_if(places(marking.points, marking.type, kStep_m), std::back_inserter(all),
                         [&](const Place& place) {
                           return (place.position - near.translation()).head<2>().norm() <= 2.0 * kFurthest_m;
                         });
  map_ = geometry::PointGrid<Place>(std::move(all), kReach_m);
}

std::vector<MapFit::Place> MapFit::places(const Polyline& line, MarkingType type, double step_m) {
  std::vector<Place> result;
  const MeasuredPolyline measured(line);
  if (measured.length() <= 0.0) return result;
  const Polyline points = measured.resample(step_m);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& before = points[i == 0 ? 0 : i - 1];
    const Point& after = points[std::min(i + 1, points.size() - 1)];
    result.push_back({points[i], (after - before).head<2>().normalized(), type == MarkingType::stopline});
  }
  return result;
}

const MapFit::Place* MapFit::nearest(const geometry::PointGrid<Place>& grid, const Place& sample) {
  const double min_cosine = cos_degrees(kMaxAngle_deg);
  const Place* best = nullptr;
  double least_m2 = 2.0 * kReach_m * kReach_m;
  grid.around(sample.position, kReach_m, [&](const Place& place) {
    const Point apart = place.position - sample.position;
    if (place.is_stopline != sample.is_stopline || apart.head<2>().squaredNorm() >= least_m2 ||
        !geometry::same_level(place.position, sample.position) ||
        std::abs(place.direction.dot(sample.direction)) < min_cosine)
      return;
    best = &place;
    least_m2 = apart.head<2>().squaredNorm();
  });
  return best;
}

/// Calls `visit(sample, beside)` for each sample, map frame, that lies beside a marking.
template <class Visit>
void MapFit::each_beside(const Eigen::Isometry3d& T_map_body, Visit&& visit) const {
  const Eigen::Vector2d ahead = T_map_body.linear().col(0).head<2>().normalized();
  for (Place sample : samples_) {
    sample.position = T_map_body * sample.position;
    sample.direction = sample.direction.x() * ahead + sample.direction.y() * geometry::left_of(ahead);
    const Place* const place = nearest(map_, sample);
    if (place == nullptr) continue;
    const Eigen::Vector2d offset = (sample.position - place->position).head<2>();
    if (std::abs(offset.dot(place->direction)) > kStep_m) continue;
    const Eigen::Vector2d normal = geometry::left_of(place->direction);
    visit(sample.position, Beside{normal, normal.dot(offset)});
  }
}

double MapFit::explained_m(const Eigen::Isometry3d& T_map_body) const {
  double sum_m = 0.0;
  each_beside(T_map_body, [&](const Point&, const Beside& beside) {
    const double misfit = beside.lateral_m / kGate_m;
    sum_m += step_m_ * std::max(0.0, 1.0 - misfit * misfit);
  });
  return sum_m;
}

// Gauss-Newton, with weights that are chosen anew in each round.
Eigen::Isometry3d MapFit::refined(Eigen::Isometry3d T_map_body) const {
  const Eigen::Matrix3d expected = kExpected.array().square().inverse().matrix().asDiagonal();
  Eigen::Vector3d all = Eigen::Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::Vector2d ahead = T_map_body.linear().col(0).head<2>().normalized();
    Eigen::Matrix3d information = expected;
    Eigen::Vector3d sum = -expected * all;
    each_beside(T_map_body, [&](const Point& sample, const Beside& beside) {
      const Eigen::Vector2d arm = (sample - T_map_body.translation()).head<2>();
      const Eigen::Vector3d row(beside.normal.dot(ahead), beside.normal.dot(geometry::left_of(ahead)),
                                beside.normal.dot(geometry::left_of(arm)));
      const double misfit = beside.lateral_m / kOutlier_m;
      const double weight = step_m_ / (kCorrelated_m * kStddev_m * kStddev_m * (1.0 + misfit * misfit));
      information += weight * row * row.transpose();
      sum -= weight * beside.lateral_m * row;
    });
    const Eigen::Vector3d step = information.ldlt().solve(sum);
    all += step;
    T_map_body = T_map_body * moved(step);
  }
  return T_map_body;
}

}  // namespace laneloom
