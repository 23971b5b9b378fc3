#include "mapping/lines/detection_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "laneloom/element_names.hpp"

namespace laneloom::lines {
namespace {

constexpr double kRing_m = 10.0;   // width of a range bin of the rates
constexpr double kRange_m = 12.0;  // width of a range bin of the confidences
constexpr double kMinRate = 0.02, kMaxRate = 0.95;
constexpr double kMinVariance = 1e-4;
constexpr double kMinLasting = 0.02;
constexpr double kMaxDeficit = 0.3;
constexpr double kLeastConfidences = 10.0;  // number that is needed to know their level
constexpr double kMinWrongHits = 3.0;       // number of hits; lines with fewer are told by that alone
constexpr double kMostAgainst = 4.0, kMostFor = 1.0;  // log odds: many wrong lines look right, too

// Priors that hold for networks in general. They weigh as much as some seconds of driving.
constexpr double kRateAhead = 0.9, kRateLossPerRing = 0.06, kRateBehind = 0.05, kRateWeight = 200.0;
constexpr double kLevelWeight = 20.0;
constexpr LearnedMean kVariance{0.12 * 0.12, 50.0}, kLasting{0.3, 10.0}, kDeficit{0.1, 10.0};

// Largest weights of what is learned. Beyond them, old values are forgotten.
constexpr double kMostViews = 3000.0, kMostConfidences = 1000.0, kMostLines = 100.0;

std::size_t bin(double range_m, double width_m, std::size_t count) {
  return std::min(static_cast<std::size_t>(range_m / width_m), count - 1);
}

/// The bin of a place: rings ahead of the vehicle come first, then rings behind it.
std::size_t place(const Point& point_body, std::size_t rings) {
  const std::size_t ring = bin(point_body.head<2>().norm(), kRing_m, rings);
  return point_body.x() >= 0.0 ? ring : rings + ring;
}

}  // namespace

void LearnedMean::add(double value, double max_weight) {
  weight = std::min(weight + 1.0, max_weight);
  mean += (value - mean) / weight;
}

void DetectionModel::each(auto& model, const auto& visit) {
  const auto named = [](std::string prefix, MarkingType type) { return prefix.append(name(type)); };
  const auto from = [](std::string name, std::size_t i, double width_m) {
    return name.append(std::to_string(std::lround(static_cast<double>(i) * width_m))).append("_m");
  };
  for (const MarkingType type : kMarkingTypes) {
    for (std::size_t ring = 0; ring < kRings; ++ring) {
      visit(from(named("rate_", type).append("_ahead_"), ring, kRing_m), model.rates_[index(type)][ring]);
      visit(from(named("rate_", type).append("_behind_"), ring, kRing_m),
            model.rates_[index(type)][kRings + ring]);
    }
    for (std::size_t i = 0; i < kRanges; ++i)
      visit(from(named("confidence_", type).append("_"), i, kRange_m), model.levels_[index(type)][i]);
    visit(named("confidence_deficit_", type), model.deficits_[index(type)]);
  }
  visit(std::string("confidence"), model.level_);
  visit(std::string("confidence_variance"), model.variance_);
  visit(std::string("confidence_lasting_share"), model.lasting_);
}

DetectionModel::DetectionModel(const NetworkProfile& profile) {
  for (auto& of_type : rates_) {
    for (std::size_t ring = 0; ring < kRings; ++ring) {
      of_type[ring] = {kRateAhead - kRateLossPerRing * static_cast<double>(ring), kRateWeight};
      of_type[kRings + ring] = {kRateBehind, kRateWeight};
    }
  }
  variance_ = kVariance;
  lasting_ = kLasting;
  deficits_.fill(kDeficit);
  each(*this, [&](const std::string& name, LearnedMean& mean) {
    if (const auto known = profile.find(name); known != profile.end())
      mean = {known->second.value, known->second.weight};
  });
}

NetworkProfile DetectionModel::profile() const {
  NetworkProfile profile;
  each(*this, [&](const std::string& name, const LearnedMean& mean) {
    profile[name] = {mean.mean, mean.weight};
  });
  return profile;
}

void DetectionModel::learn_rate(MarkingType type, const Point& point_body, bool seen) {
  rates_[index(type)][place(point_body, kRings)].add(seen ? 1.0 : 0.0, kMostViews);
}

double DetectionModel::rate(MarkingType type, const Point& point_body) const {
  return std::clamp(rates_[index(type)][place(point_body, kRings)].mean, kMinRate, kMaxRate);
}

void DetectionModel::learn_confidence(MarkingType type, double range_m, double confidence) {
  if (knows_confidences()) {
    const double above = surplus(type, range_m, confidence);
    variance_.add(above * above, kMostConfidences);
  }
  level_.add(confidence, kMostConfidences);
  levels_[index(type)][bin(range_m, kRange_m, kRanges)].add(confidence, kMostConfidences);
}

bool DetectionModel::knows_confidences() const { return level_.weight >= kLeastConfidences; }

double DetectionModel::surplus(MarkingType type, double range_m, double confidence) const {
  // While little is known of this range, the level of all ranges stands in.
  const LearnedMean& there = levels_[index(type)][bin(range_m, kRange_m, kRanges)];
  const double share = there.weight / (there.weight + kLevelWeight);
  return confidence - (share * there.mean + (1.0 - share) * level_.mean);
}

void DetectionModel::learn_right(const Confidences& confidences) {
  // The mean of independent values would have a share of 1 / count of their variance. The rest of the mean's
  // variance is common to all confidences of the line.
  const double noise = 1.0 / confidences.count;
  const double share = confidences.mean * confidences.mean / std::max(kMinVariance, variance_.mean);
  lasting_.add((share - noise) / (1.0 - noise), kMostLines);
}

void DetectionModel::learn_wrong(MarkingType type, const Confidences& confidences) {
  if (confidences.count >= kMinWrongHits) deficits_[index(type)].add(-confidences.mean, kMostLines);
}

double DetectionModel::variance_of_mean(double count) const {
  const double lasting = std::clamp(lasting_.mean, kMinLasting, 1.0);
  return std::max(kMinVariance, variance_.mean) * (lasting + (1.0 - lasting) / std::max(1.0, count));
}

double DetectionModel::log_odds(MarkingType type, const Confidences& confidences) const {
  if (confidences.count <= 0.0) return 0.0;
  // Right and wrong lines are taken as two normal distributions that differ in their mean alone.
  const double deficit = std::clamp(deficits_[index(type)].mean, 0.0, kMaxDeficit);
  const double ratio = deficit * (confidences.mean + 0.5 * deficit) / variance_of_mean(confidences.count);
  return std::clamp(ratio, -kMostAgainst, kMostFor);
}

}  // namespace laneloom::lines
