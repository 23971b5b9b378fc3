#include "mapping/lines/network_model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mapping/geometry/reproducible.hpp"

namespace laneloom {
namespace {

constexpr double kMemory = 20000.0;    // views; those of neighbouring stations are hardly different ones
constexpr double kPriorViews = 50.0;   // that the configured deviation counts for
constexpr double kPriorGain = 100.0;   // squared deviations that speak against any suspicion
constexpr double kPriorPairs = 100.0;  // that the correlation below counts for
constexpr double kPriorCorrelation_m = 10.0, kPriorDistance_m = 8.0;
constexpr double kMinStddev_m = 0.02, kMaxStddev_m = 1.0;
constexpr double kMinCorrelation_m = 2.0, kMaxCorrelation_m = 15.0;
constexpr double kOutlier = 3.0;  // deviations, from which an error counts as no larger

/// The nodes that a range lies between, and its share of the way to the further one.
struct Between {
  std::size_t node;
  double share;
};

Between between(double range_m) {
  const auto& nodes_m = NetworkModel::kNodes_m;
  const auto next = std::upper_bound(nodes_m.begin() + 1, nodes_m.end() - 1, range_m);
  const auto node = static_cast<std::size_t>(next - nodes_m.begin()) - 1;
  return {node, std::clamp((range_m - nodes_m[node]) / (nodes_m[node + 1] - nodes_m[node]), 0.0, 1.0)};
}

void add(double value, double& sum) { sum += value - sum / kMemory; }

}  // namespace

double Gain::value() const { return std::clamp(effect_ / (evidence_ + kPriorGain), 0.0, 1.0); }

void Gain::learn(double suspected, double proved) {
  add(suspected * suspected, evidence_);
  add(suspected * proved, effect_);
}

NetworkModel::NetworkModel(const FusionConfig& config)
    : pairs_(kPriorPairs),
      products_(kPriorPairs * kShared * reproducible::exp(-kPriorDistance_m / kPriorCorrelation_m)),
      distances_m_(kPriorPairs * kPriorDistance_m) {
  for (std::size_t i = 0; i < kNodes_m.size(); ++i) {
    const double stddev_m = config.stddev_m + config.stddev_per_m * kNodes_m[i];
    views_[i] = kPriorViews;
    squares_m2_[i] = kPriorViews * stddev_m * stddev_m;
  }
}

double NetworkModel::stddev_m(double range_m) const {
  const auto [node, share] = between(range_m);
  const auto variance_m2 = [this](std::size_t i) { return squares_m2_[i] / views_[i]; };
  const double here_m2 = (1.0 - share) * variance_m2(node) + share * variance_m2(node + 1);
  return std::clamp(std::sqrt(here_m2), kMinStddev_m, kMaxStddev_m);
}

double NetworkModel::correlation_m() const {
  const double correlation = std::clamp(products_ / pairs_ / kShared, 0.01, 0.99);
  return std::clamp(-distances_m_ / pairs_ / reproducible::log(correlation), kMinCorrelation_m,
                    kMaxCorrelation_m);
}

double NetworkModel::error_m(const FarView& view, double near_m) const {
  const double limit_m = kOutlier * stddev_m(view.range_m);
  return std::clamp(
      view.lateral_m - near_m - pitch_gain() * view.stretched_m - alignment_gain() * view.misplaced_m,
      -limit_m, limit_m);
}

void NetworkModel::learn(const FarView& view, double near_m) {
  const double stddev_m = this->stddev_m(view.range_m), error_m = this->error_m(view, near_m);
  // Each explains what the other one leaves.
  const double stretched = view.stretched_m / stddev_m, misplaced = view.misplaced_m / stddev_m;
  const double left = error_m / stddev_m;
  pitch_.learn(stretched, left + pitch_gain() * stretched);
  alignment_.learn(misplaced, left + alignment_gain() * misplaced);
  const auto [node, share] = between(view.range_m);
  for (const auto& [i, weight] : {std::pair(node, 1.0 - share), {node + 1, share}}) {
    squares_m2_[i] += weight * (error_m * error_m - squares_m2_[i] / kMemory);
    views_[i] += weight * (1.0 - views_[i] / kMemory);
  }
}

void NetworkModel::learn(const FarView& one, const FarView& other, double near_m) {
  add(1.0, pairs_);
  add(error_m(one, near_m) / stddev_m(one.range_m) * error_m(other, near_m) / stddev_m(other.range_m),
      products_);
  add(std::abs(one.range_m - other.range_m), distances_m_);
}

std::vector<std::pair<std::string, double>> NetworkModel::learned() const {
  std::vector<std::pair<std::string, double>> values;
  values.reserve(kNodes_m.size() + 3);
  for (const double range_m : kNodes_m)
    values.emplace_back("stddev_at_" + std::to_string(std::lround(range_m)) + "_m", stddev_m(range_m));
  values.emplace_back("correlation_m", correlation_m());
  values.emplace_back("pitch_gain", pitch_gain());
  values.emplace_back("alignment_gain", alignment_gain());
  return values;
}

}  // namespace laneloom
