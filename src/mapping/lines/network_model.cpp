#include "mapping/lines/network_model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

namespace laneloom::lines {
namespace {

constexpr double kMemory = 20000.0;   // views; those of neighbouring stations are nearly the same
constexpr double kPriorViews = 50.0;  // weight of the configured deviation, in views
// Evidence that speaks against each suspicion, in squared deviations. Frames in a row tell of one lasting
// pitch.
const PerSuspicion kPriorGains{100.0, 300.0, 100.0};
constexpr double kMinLearned_m = 0.02, kMaxLearned_m = 1.0;
constexpr double kOutlier = 3.0;  // deviations; a larger error counts as this

/// A range between two nodes: the nearer node, and the share of the way to the next one.
struct Between {
  std::size_t node;
  double share;
};

Between between(double range_m) {
  const auto& nodes_m = NetworkModel::kNodes_m;
  const auto* const next = std::upper_bound(nodes_m.begin() + 1, nodes_m.end() - 1, range_m);
  const auto node = static_cast<std::size_t>(next - nodes_m.begin()) - 1;
  return {node, std::clamp((range_m - nodes_m[node]) / (nodes_m[node + 1] - nodes_m[node]), 0.0, 1.0)};
}

constexpr std::array<std::pair<Suspicion, const char*>, PerSuspicion::SizeAtCompileTime> kGainNames{
    {{kSuddenPitch, "pitch_gain"}, {kLastingPitch, "lasting_pitch_gain"}, {kPose, "alignment_gain"}}};

std::string stddev_name(double range_m) { return "stddev_at_" + std::to_string(std::lround(range_m)) + "_m"; }

}  // namespace

PerSuspicion Gains::values() const {
  return effect_.cwiseQuotient(evidence_ + kPriorGains).cwiseMax(0.0).cwiseMin(1.0);
}

void Gains::start_with(Suspicion suspicion, const LearnedValue& known) {
  evidence_[suspicion] = known.weight;
  effect_[suspicion] = known.value * (known.weight + kPriorGains[suspicion]);
}

void Gains::learn(const PerSuspicion& suspected, const PerSuspicion& proved) {
  evidence_ += suspected.cwiseAbs2() - evidence_ / kMemory;
  effect_ += suspected.cwiseProduct(proved) - effect_ / kMemory;
}

NetworkModel::NetworkModel(const FusionConfig& config, const NetworkProfile& profile) {
  const auto known = [&profile](const std::string& name, const LearnedValue& otherwise) {
    const auto found = profile.find(name);
    return found != profile.end() ? found->second : otherwise;
  };
  for (std::size_t i = 0; i < kNodes_m.size(); ++i) {
    const auto [stddev_m, views] =
        known(stddev_name(kNodes_m[i]), {config.stddev_m + config.stddev_per_m * kNodes_m[i], kPriorViews});
    views_[i] = views;
    squares_m2_[i] = views * stddev_m * stddev_m;
  }
  for (const auto& [suspicion, name] : kGainNames) gains_.start_with(suspicion, known(name, {}));
}

double NetworkModel::stddev_m(double range_m) const {
  const auto [node, share] = between(range_m);
  const auto variance_m2 = [this](std::size_t i) { return squares_m2_[i] / views_[i]; };
  const double here_m2 = (1.0 - share) * variance_m2(node) + share * variance_m2(node + 1);
  return std::clamp(std::sqrt(here_m2), kMinLearned_m, kMaxLearned_m);
}

void NetworkModel::learn(const FarView& view, double near_m) {
  const double stddev_m = this->stddev_m(view.range_m), limit_m = kOutlier * stddev_m;
  const PerSuspicion taken_m = gains().cwiseProduct(view.suspected_m);
  const double error_m = std::clamp(view.lateral_m - near_m - taken_m.sum(), -limit_m, limit_m);
  // Each gain learns from the error that the others leave.
  gains_.learn(view.suspected_m / stddev_m, (PerSuspicion::Constant(error_m) + taken_m) / stddev_m);
  const auto [node, share] = between(view.range_m);
  for (const auto& [i, weight] : {std::pair(node, 1.0 - share), {node + 1, share}}) {
    squares_m2_[i] += weight * (error_m * error_m - squares_m2_[i] / kMemory);
    views_[i] += weight * (1.0 - views_[i] / kMemory);
  }
}

NetworkProfile NetworkModel::profile() const {
  NetworkProfile profile;
  const PerSuspicion shares = gains();
  for (const auto& [suspicion, name] : kGainNames)
    profile[name] = {shares[suspicion], gains_.evidence()[suspicion]};
  for (std::size_t i = 0; i < kNodes_m.size(); ++i)
    profile[stddev_name(kNodes_m[i])] = {stddev_m(kNodes_m[i]), views_[i]};
  return profile;
}

}  // namespace laneloom::lines
