#include "evaluation/stability.hpp"

#include <algorithm>
#include <cmath>

#include "laneloom/polyline.hpp"

namespace laneloom::evaluation {
namespace {

constexpr double kStep_m = 1.0;

Polyline in_map(const Polyline& points_body, const Eigen::Isometry3d& T_map_body) {
  Polyline points;
  points.reserve(points_body.size());
  for (const Point& point : points_body) points.push_back(T_map_body * point);
  return points;
}

std::vector<double> jitters_m(const Polyline& before, const Polyline& now) {
  const MeasuredPolyline earlier(before);
  std::vector<double> jitters_m;
  for (const Point& place : MeasuredPolyline(now).resample(kStep_m)) {
    const Projection projection = earlier.project(place);
    if (projection.inside) jitters_m.push_back(std::abs(projection.lateral_m));
  }
  return jitters_m;
}

double share_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double Stability::id_switches_per_km() const {
  return driven_past_m > 0.0 ? 1000.0 * static_cast<double>(id_switches) / driven_past_m : 0.0;
}

double Stability::flicker() const { return share_of(lost, was_right); }

StabilityMeter::StabilityMeter(const std::vector<KindLine>& truth, const RangeConfig& range)
    : range_(range), truths_(truth.size()) {
  for (std::size_t i = 0; i < truth.size(); ++i) {
    kinds_.push_back(truth[i].kind);
    const MeasuredPolyline line(truth[i].points);
    const auto stretches = static_cast<std::size_t>(std::max(1.0, std::ceil(line.length() / kStep_m)));
    truths_[i].stretch_m = line.length() / static_cast<double>(stretches);
    for (std::size_t k = 0; k < stretches; ++k)
      truths_[i].stations.push_back(line.at((static_cast<double>(k) + 0.5) * truths_[i].stretch_m));
  }
}

void StabilityMeter::add_driven_past(const Eigen::Isometry3d& T_body_map, TruthState& state,
                                     Stability& stability) const {
  const std::size_t seen = std::erase_if(
      state.stations, [&](const Point& station) { return in_range(T_body_map * station, range_); });
  stability.driven_past_m += static_cast<double>(seen) * state.stretch_m;
}

void StabilityMeter::add(const FrameComparison& frame, const std::vector<KindLine>& predictions) {
  const Eigen::Isometry3d T_body_map = frame.T_map_body.inverse();
  std::vector<std::optional<Polyline>> published(truths_.size());
  Distribution frame_jitter_m;
  for (std::size_t i = 0; i < kLineKindCount; ++i) {
    Stability& stability = by_kind_[i];
    for (const TruthOutcome& outcome : truth_outcomes(frame.by_kind[i])) {
      TruthState& state = truths_[outcome.truth];
      if (state.published) {
        ++stability.was_right;
        if (outcome.prediction == nullptr) ++stability.lost;
      }
      if (outcome.prediction == nullptr) continue;
      Polyline now = in_map(outcome.prediction->points, frame.T_map_body);
      if (state.published) {
        for (const double jitter_m : jitters_m(*state.published, now)) {
          stability.jitter_m.add(jitter_m);
          if (kinds_[outcome.truth] != LineKind::lane) frame_jitter_m.add(jitter_m);
        }
      }
      const ElementId id = predictions[outcome.prediction->line].id;
      if (id != kNoElement) {
        stability.has_ids = true;
        if (state.id != kNoElement && state.id != id) ++stability.id_switches;
        state.id = id;
      }
      published[outcome.truth] = std::move(now);
    }
  }
  jitter_over_time_m_.push_back(frame_jitter_m.count() > 0 ? std::optional(frame_jitter_m.mean())
                                                           : std::nullopt);
  for (std::size_t i = 0; i < truths_.size(); ++i) {
    add_driven_past(T_body_map, truths_[i], by_kind_[index(kinds_[i])]);
    truths_[i].published = std::move(published[i]);
  }
}

}  // namespace laneloom::evaluation
