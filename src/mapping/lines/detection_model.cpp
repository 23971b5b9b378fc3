#include "mapping/lines/detection_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "laneloom/element_names.hpp"

namespace laneloom::lines {
namespace {

constexpr double kRing_m = 10.0;  // width of a range bin of the rates
constexpr double kMinRate = 0.02, kMaxRate = 0.95;
constexpr double kMinConfidence = 0.05;
constexpr double kLeastConfidences = 10.0;  // number that is needed to know their level

// Priors that hold for networks in general. They weigh as much as some seconds of driving.
constexpr double kRateAhead = 0.9, kRateLossPerRing = 0.06, kRateBehind = 0.05, kRateWeight = 200.0;
constexpr LearnedMean kConfidence{kUsualBelief, 10.0};

// Largest weights of what is learned. Beyond them, old values are forgotten.
constexpr double kMostViews = 3000.0, kMostConfidences = 1000.0;

/// The bin of a place: rings ahead of the vehicle come first, then rings behind it.
std::size_t place(const Point& point_body, std::size_t rings) {
  const std::size_t ring =
      std::min(static_cast<std::size_t>(point_body.head<2>().norm() / kRing_m), rings - 1);
  return point_body.x() >= 0.0 ? ring : rings + ring;
}

}  // namespace

void LearnedMean::add(double value, double max_weight) {
  weight = std::min(weight + 1.0, max_weight);
  mean += (value - mean) / weight;
}

void DetectionModel::each(auto& model, const auto& visit) {
  const auto rate_name = [](MarkingType type, const char* side, std::size_t ring) {
    const long from_m = std::lround(static_cast<double>(ring) * kRing_m);
    return std::string("rate_").append(name(type)).append(side).append(std::to_string(from_m)).append("_m");
  };
  for (const MarkingType type : kMarkingTypes) {
    for (std::size_t ring = 0; ring < kRings; ++ring) {
      visit(rate_name(type, "_ahead_", ring), model.rates_[index(type)][ring]);
      visit(rate_name(type, "_behind_", ring), model.rates_[index(type)][kRings + ring]);
    }
  }
  visit(std::string("confidence"), model.confidence_);
}

DetectionModel::DetectionModel(const NetworkProfile& profile) : confidence_(kConfidence) {
  for (auto& of_type : rates_) {
    for (std::size_t ring = 0; ring < kRings; ++ring) {
      of_type[ring] = {kRateAhead - kRateLossPerRing * static_cast<double>(ring), kRateWeight};
      of_type[kRings + ring] = {kRateBehind, kRateWeight};
    }
  }
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

void DetectionModel::learn_confidence(double confidence) { confidence_.add(confidence, kMostConfidences); }

bool DetectionModel::knows_confidences() const {
  return confidence_.weight >= kConfidence.weight + kLeastConfidences;
}

double DetectionModel::belief(double confidence) const {
  return std::min(1.0, confidence * kUsualBelief / std::max(kMinConfidence, confidence_.mean));
}

}  // namespace laneloom::lines
