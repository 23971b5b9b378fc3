#include "evaluation/trust.hpp"

#include <algorithm>
#include <cmath>

namespace laneloom::evaluation {
namespace {

void add_confidences(const KindComparison& comparison, const std::vector<KindLine>& predictions,
                     Trust& trust) {
  std::vector<bool> right(comparison.predictions.size());
  for (const TruePositive& match : comparison.matches) right[match.prediction] = true;
  for (std::size_t i = 0; i < right.size(); ++i) {
    const double confidence = predictions[comparison.predictions[i].line].confidence;
    if (!(confidence >= 0.0 && confidence <= 1.0)) continue;
    const auto place = static_cast<std::size_t>(confidence * kCalibrationBins);
    CalibrationBin& bin = trust.calibration[std::min(place, kCalibrationBins - 1)];
    ++bin.count;
    bin.confidences += confidence;
    if (right[i]) ++bin.right;
  }
}

}  // namespace

bool Trust::has_confidences() const {
  return std::ranges::any_of(calibration, [](const CalibrationBin& bin) { return bin.count > 0; });
}

double Trust::within_2_sigma() const {
  return vertices == 0 ? 0.0 : static_cast<double>(vertices_within_2_sigma) / static_cast<double>(vertices);
}

double Trust::expected_calibration_error() const {
  double weighted = 0.0;
  std::size_t count = 0;
  for (const CalibrationBin& bin : calibration) {
    weighted += std::abs(bin.confidence() - bin.precision()) * static_cast<double>(bin.count);
    count += bin.count;
  }
  return count == 0 ? 0.0 : weighted / static_cast<double>(count);
}

TrustMeter::TrustMeter(const std::vector<KindLine>& truth, const RangeConfig& range) : range_(range) {
  for (const KindLine& line : truth)
    truths_.push_back({MeasuredPolyline(line.points), line.kind == LineKind::lane, false, std::nullopt, 0.0});
}

void TrustMeter::add_vertices(const KindLine& prediction, const MeasuredPolyline& truth,
                              const Eigen::Isometry3d& T_body_map, Trust& trust) const {
  if (prediction.lateral_stddev_m.size() != prediction.points.size()) return;
  for (std::size_t i = 0; i < prediction.points.size(); ++i) {
    if (!in_range(T_body_map * prediction.points[i], range_)) continue;
    const Projection projection = truth.project(prediction.points[i]);
    if (!projection.inside) continue;
    ++trust.vertices;
    if (projection.distance_m <= 2.0 * prediction.lateral_stddev_m[i]) ++trust.vertices_within_2_sigma;
  }
}

void TrustMeter::add_appearance(const TruthOutcome& outcome, std::int64_t stamp_ns, Trust& trust) {
  TruthState& state = truths_[outcome.truth];
  if (!state.in_range_since_ns) {
    state.in_range_since_ns = stamp_ns;
    state.in_range_since_m = driven_m_;
  }
  if (state.right || outcome.prediction == nullptr) return;
  state.right = true;
  trust.first_appearance_s.add(static_cast<double>(stamp_ns - *state.in_range_since_ns) * 1e-9);
  trust.first_appearance_m.add(driven_m_ - state.in_range_since_m);
}

void TrustMeter::add(const FrameComparison& frame, const std::vector<KindLine>& predictions) {
  const Point position = frame.T_map_body.translation();
  if (position_) driven_m_ += (position - *position_).head<2>().norm();
  position_ = position;
  const Eigen::Isometry3d T_body_map = frame.T_map_body.inverse();
  for (std::size_t i = 0; i < kLineKindCount; ++i) {
    Trust& trust = static_cast<LineKind>(i) == LineKind::lane ? lanes_ : markings_;
    add_confidences(frame.by_kind[i], predictions, trust);
    for (const TruthOutcome& outcome : truth_outcomes(frame.by_kind[i])) {
      add_appearance(outcome, frame.stamp_ns, trust);
      if (outcome.prediction != nullptr)
        add_vertices(predictions[outcome.prediction->line], truths_[outcome.truth].line, T_body_map, trust);
    }
  }
}

Trust TrustMeter::with_never_appeared(Trust trust, bool lanes) const {
  trust.never_appeared =
      static_cast<std::size_t>(std::count_if(truths_.begin(), truths_.end(), [&](const TruthState& state) {
        return state.is_lane == lanes && state.in_range_since_ns && !state.right;
      }));
  return trust;
}

}  // namespace laneloom::evaluation
