#include "export/align.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/degree.hpp"
#include "export/drive_stations.hpp"
#include "export/motions.hpp"

namespace laneloom::exports {
namespace {

/// A motion, and drift: how far the vehicle comes ahead (m) and turns left (rad) beyond what its poses say,
/// per metre driven.
using State = Eigen::Matrix<double, 6, 1>;
using Covariance = Eigen::Matrix<double, 6, 6>;

// Deviations of a drive's place and drift at first, and of what changes from station to station.
constexpr double kFirst_m = 3.0;
const State kFirstStddev{{kFirst_m, kFirst_m, kFirst_m, 1.0 * kDegree, 0.02, 3e-4}};
const State kStepStddev{{0.02, 0.02, 0.05, 3e-4, 1e-3, 2e-5}};
// Where the road is not known, nothing holds the drift that was found: it is forgotten over this.
constexpr double kDriftMemory_m = 30.0;
// A sample is met within this, and within kGateSigmas of what is doubted. The errors of a line's samples are
// not independent: together they count as one every 10 m.
constexpr double kGate_m = 0.5, kGateSigmas = 2.5, kMaxGate_m = 1.8, kMaxStoplineGate_m = 5.0;
constexpr double kSampleStddev_m = 0.1, kHeightStddev_m = 0.3, kDependence = 5.0;
constexpr int kIterations = 10;
constexpr double kSettled_m = 1e-3;
// A search is needed where the place across is doubted by more than this.
constexpr double kLost_m = 0.8;
constexpr std::size_t kSearchStations = 8;
constexpr double kSearch_m = 6.0, kSearchStep_m = 0.75, kSearchYaw = 1.5 * kDegree;
constexpr double kFound = 0.5;     // least share of the samples that are met
constexpr double kSecond = 0.85;   // greatest share of the best score that a place beside may have
constexpr double kBeside_m = 1.5;  // across, between places that are told apart
constexpr double kFoundStddev_m = 0.5;
constexpr std::size_t kMinSamples = 20;

/// A transform from the drive to the road, with the drift, and how they are doubted about the vehicle's
/// place.
struct Estimate {
  Eigen::Isometry3d T_road_drive = Eigen::Isometry3d::Identity();
  Eigen::Vector2d drift = Eigen::Vector2d::Zero();
  Covariance covariance = kFirstStddev.cwiseAbs2().asDiagonal();
  bool is_held = false;  ///< samples of the station lie on the road
};

/// The change from one estimate to another.
State difference(const Estimate& from, const Estimate& to, const Point& about) {
  State by;
  by << motion(from.T_road_drive, to.T_road_drive, about), to.drift - from.drift;
  return by;
}

void change(Estimate& estimate, const State& by, const Point& about) {
  estimate.T_road_drive = moved(estimate.T_road_drive, by.head<4>(), about);
  estimate.drift += by.tail<2>();
}

/// Follows a drive along a road.
class Follower {
 public:
  Follower(const std::vector<DriveStation>& stations, const LineArchive& road, double stddev_m)
      : stations_(stations), road_(road) {
    first_.covariance.topLeftCorner<3, 3>() = stddev_m * stddev_m * Eigen::Matrix3d::Identity();
  }

  /// The estimates for the stations. The last one is smoothed as it is; the covariances are the filter's.
  std::vector<Estimate> follow();

 private:
  Point place(std::size_t k, const Eigen::Isometry3d& T_road_drive) const {
    return T_road_drive * Point(stations_[k].T_drive_body.translation());
  }
  Eigen::Vector2d heading(std::size_t k, const Eigen::Isometry3d& T_road_drive) const {
    return (T_road_drive.linear() * stations_[k].T_drive_body.linear().col(0)).head<2>().normalized();
  }
  Estimate predict(std::size_t k, const Estimate& before, Covariance& carry) const;
  bool is_lost(std::size_t k, const Estimate& estimate) const;
  void search(std::size_t k, Estimate& estimate) const;
  double score(const std::vector<const DriveStation::Sample*>& samples, const Eigen::Isometry3d& T,
               double& met) const;
  void correct(std::size_t k, Estimate& estimate) const;
  std::optional<LineArchive::Place> meet(const DriveStation::Sample& sample, const Eigen::Isometry3d& T,
                                         double gate_m) const;

  const std::vector<DriveStation>& stations_;
  const LineArchive& road_;
  Estimate first_;
};

/// The estimate for a station by that for the one before. `carry` is its derivative.
Estimate Follower::predict(std::size_t k, const Estimate& before, Covariance& carry) const {
  const double driven_m = stations_[k].driven_m - stations_[k - 1].driven_m;
  const Point from = place(k - 1, before.T_road_drive), to = place(k, before.T_road_drive);
  const Eigen::Vector2d ahead = driven_m * heading(k, before.T_road_drive);
  carry.setIdentity();
  carry.block<2, 1>(0, 3) = left_of((to - from).head<2>());
  carry.block<2, 1>(0, 4) = ahead;
  carry.block<2, 1>(0, 5) = 0.5 * driven_m * left_of(ahead);
  carry(3, 5) = driven_m;
  const double kept = before.is_held ? 1.0 : std::exp(-driven_m / kDriftMemory_m);
  carry.bottomRightCorner<2, 2>() *= kept;
  Estimate estimate{.T_road_drive = before.T_road_drive};
  State drift = State::Zero();
  drift.tail<2>() = before.drift;
  change(estimate, carry * drift, to);
  estimate.covariance = carry * before.covariance * carry.transpose();
  estimate.covariance.diagonal() += driven_m / kStation_m * kStepStddev.cwiseAbs2();
  estimate.covariance.diagonal().tail<2>() += (1.0 - kept * kept) * kFirstStddev.tail<2>().cwiseAbs2();
  return estimate;
}

bool Follower::is_lost(std::size_t k, const Estimate& estimate) const {
  const Eigen::Vector2d across = left_of(heading(k, estimate.T_road_drive));
  return across.dot(estimate.covariance.topLeftCorner<2, 2>() * across) > kLost_m * kLost_m;
}

std::optional<LineArchive::Place> Follower::meet(const DriveStation::Sample& sample,
                                                 const Eigen::Isometry3d& T, double gate_m) const {
  return road_.nearest(sample.type, T * sample.position, T.linear().topLeftCorner<2, 2>() * sample.along,
                       gate_m);
}

/// A score of how well samples lie on the road, and the number of those that do.
double Follower::score(const std::vector<const DriveStation::Sample*>& samples, const Eigen::Isometry3d& T,
                       double& met) const {
  double score = 0.0;
  met = 0.0;
  for (const DriveStation::Sample* sample : samples) {
    const auto near = meet(*sample, T, kSearchStep_m);
    if (!near) continue;
    met += 1.0;
    score += 1.0 - ((T * sample->position - near->foot).head<2>().norm()) / kSearchStep_m;
  }
  return score;
}

/// Tries the places around. Of those that are equally good, the nearest is taken.
void Follower::search(std::size_t k, Estimate& estimate) const {
  std::vector<const DriveStation::Sample*> samples;
  for (std::size_t i = k; i < std::min(stations_.size(), k + kSearchStations); ++i)
    for (const DriveStation::Sample& sample : stations_[i].samples) samples.push_back(&sample);
  if (samples.size() < kMinSamples) return;
  const Point about = place(k, estimate.T_road_drive);
  const Eigen::Vector2d ahead = heading(k, estimate.T_road_drive), across = left_of(ahead);
  struct Try {
    Motion by = Motion::Zero();
    double across_m = 0.0, score = 0.0, met = 0.0;
  };
  std::vector<Try> tries;
  const int steps = static_cast<int>(kSearch_m / kSearchStep_m);
  for (int i = -steps; i <= steps; ++i)
    for (int j = -steps; j <= steps; ++j)
      for (const double yaw : {-kSearchYaw, 0.0, kSearchYaw}) {
        const Eigen::Vector2d to = kSearchStep_m * (i * ahead + j * across);
        Try next{.by = Motion(to.x(), to.y(), 0.0, yaw), .across_m = kSearchStep_m * j};
        next.score = score(samples, moved(estimate.T_road_drive, next.by, about), next.met);
        next.score *= std::exp(-0.5 * to.squaredNorm() / (4.0 * kSearch_m * kSearch_m));
        tries.push_back(next);
      }
  const Try best = *std::ranges::max_element(tries, {}, &Try::score);
  const bool is_ambiguous = std::ranges::any_of(tries, [&](const Try& other) {
    return std::abs(other.across_m - best.across_m) >= kBeside_m && other.score > kSecond * best.score;
  });
  if (best.met < kFound * static_cast<double>(samples.size()) || is_ambiguous) return;
  estimate.T_road_drive = moved(estimate.T_road_drive, best.by, about);
  State stddev = kFirstStddev;
  stddev.head<4>() << kFoundStddev_m, kFoundStddev_m, kFoundStddev_m, kSearchYaw;
  estimate.covariance = stddev.cwiseAbs2().asDiagonal();
}

void Follower::correct(std::size_t k, Estimate& estimate) const {
  const Estimate prior = estimate;
  const Covariance held = prior.covariance.inverse();
  const Point about = place(k, prior.T_road_drive);
  Covariance H = held;
  estimate.is_held = false;
  for (int i = 0; i < kIterations; ++i) {
    H = held;
    State g = held * difference(prior, estimate, about);
    for (const DriveStation::Sample& sample : stations_[k].samples) {
      const Eigen::Vector2d across =
          left_of(estimate.T_road_drive.linear().topLeftCorner<2, 2>() * sample.along);
      const Point point = estimate.T_road_drive * sample.position;
      State a = State::Zero();
      a.head<4>() << across, 0.0, across.dot(left_of((point - about).head<2>()));
      const double most_m = sample.type == MarkingType::stopline ? kMaxStoplineGate_m : kMaxGate_m;
      const double gate_m = std::min(most_m, kGate_m + kGateSigmas * std::sqrt(a.dot(prior.covariance * a)));
      const auto near = meet(sample, estimate.T_road_drive, gate_m);
      if (!near) continue;
      estimate.is_held = true;
      const Eigen::Vector2d normal = left_of(near->along);
      const double residual_m = normal.dot((point - near->foot).head<2>());
      const double kernel_m = gate_m / 3.0, weight = 1.0 / (1.0 + std::pow(residual_m / kernel_m, 2));
      const double variance =
          kDependence * (sample.stddev_m * sample.stddev_m + near->stddev_m * near->stddev_m +
                         kSampleStddev_m * kSampleStddev_m);
      a.head<4>() << normal, 0.0, normal.dot(left_of((point - about).head<2>()));
      H += weight / variance * a * a.transpose();
      g += weight / variance * residual_m * a;
      const double height = 1.0 / (kDependence * kHeightStddev_m * kHeightStddev_m);
      H(2, 2) += height;
      g[2] += height * (point.z() - near->foot.z());
    }
    const State step = -H.ldlt().solve(g);
    change(estimate, step, about);
    if (step.head<2>().norm() < kSettled_m) break;
  }
  estimate.covariance = H.inverse();
}

std::vector<Estimate> Follower::follow() {
  std::vector<Estimate> predicted, filtered;
  std::vector<Covariance> carried;
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    Covariance& carry = carried.emplace_back(Covariance::Identity());
    Estimate estimate = k > 0 ? predict(k, filtered.back(), carry) : first_;
    predicted.push_back(estimate);
    if (is_lost(k, estimate)) search(k, estimate);
    if (!is_lost(k, estimate)) correct(k, estimate);
    filtered.push_back(estimate);
  }
  for (std::size_t k = stations_.size() - 1; k-- > 0;) {
    const Estimate &ahead = predicted[k + 1], &smoothed = filtered[k + 1];
    const Covariance gain = filtered[k].covariance * carried[k + 1].transpose() * ahead.covariance.inverse();
    const State found = difference(ahead, smoothed, place(k + 1, ahead.T_road_drive));
    change(filtered[k], gain * found, place(k, filtered[k].T_road_drive));
  }
  return filtered;
}

}  // namespace

std::vector<Eigen::Isometry3d> align(const DriveLines& drive, const LineArchive& road) {
  if (road.empty() || drive.poses.empty())
    return std::vector<Eigen::Isometry3d>(drive.poses.size(), Eigen::Isometry3d::Identity());
  const std::vector<DriveStation> stations = stations_of(drive);
  std::vector<Eigen::Isometry3d> T_road_drive;
  for (const Estimate& estimate : Follower(stations, road, kFirst_m).follow())
    T_road_drive.push_back(estimate.T_road_drive);
  return between(stations, T_road_drive, drive);
}

std::optional<EndOnRoad> end_on_road(const DriveLines& drive, const LineArchive& road, double stddev_m) {
  if (road.empty() || drive.poses.empty()) return std::nullopt;
  const std::vector<DriveStation> stations = stations_of(drive);
  const Estimate end = Follower(stations, road, stddev_m).follow().back();
  if (!end.is_held) return std::nullopt;
  return EndOnRoad{end.T_road_drive, end.covariance.topLeftCorner<4, 4>()};
}

double met_share(const std::vector<ArchivedPiece>& pieces, const LineArchive& road) {
  std::size_t met = 0, all = 0;
  for (const ArchivedPiece& piece : pieces) {
    for (const DriveStation::Sample& sample : samples_of(piece.marking)) {
      met += road.nearest(sample.type, sample.position, sample.along, kSameLine_m) ? 1U : 0U;
      ++all;
    }
  }
  return all == 0 ? 0.0 : static_cast<double>(met) / static_cast<double>(all);
}

}  // namespace laneloom::exports
