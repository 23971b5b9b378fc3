#include "evaluation/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "evaluation/sample_grid.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::evaluation {
namespace {

double ratio(double part, std::size_t whole) { return whole == 0 ? 0.0 : part / static_cast<double>(whole); }

std::vector<Polyline> samples_of(const std::vector<LinePiece>& pieces) {
  std::vector<Polyline> samples;
  samples.reserve(pieces.size());
  for (const LinePiece& piece : pieces) samples.push_back(piece.samples);
  return samples;
}

bool has_near(const SampleGrid& grid, const Point& sample) {
  bool near = false;
  grid.visit_near(sample, [&](std::size_t, double) { near = true; });
  return near;
}

/// The distance from the nearest of the lines that have a sample near by. None: there is no such line.
std::optional<double> lateral_error_m(const SampleGrid& grid, const std::vector<MeasuredPolyline>& lines,
                                      const Point& sample) {
  std::optional<std::size_t> nearest;
  double nearest_m = std::numeric_limits<double>::infinity();
  grid.visit_near(sample, [&](std::size_t line, double distance_m) {
    if (distance_m >= nearest_m) return;
    nearest = line;
    nearest_m = distance_m;
  });
  if (!nearest) return std::nullopt;
  return lines[*nearest].project(sample).distance_m;
}

}  // namespace

double SampleScore::recall() const { return ratio(static_cast<double>(found), truths); }
double SampleScore::precision() const { return ratio(static_cast<double>(right), predictions); }
double SampleScore::lateral_error_m() const { return ratio(lateral_errors_m, right); }

void LateralErrors::add(double error_m) {
  const auto millimetre = static_cast<std::size_t>(std::round(error_m * 1000.0));
  ++by_millimetre_[std::min(millimetre, kMillimetres - 1)];
  ++count_;
}

double LateralErrors::quantile(double share) const {
  const double rank = share * static_cast<double>(count_);
  std::size_t below = 0;
  for (std::size_t millimetre = 0; millimetre < kMillimetres; ++millimetre) {
    below += by_millimetre_[millimetre];
    if (below > 0 && static_cast<double>(below) >= rank) return static_cast<double>(millimetre) / 1000.0;
  }
  return 0.0;
}

ProfileMeter::ProfileMeter(const RangeConfig& range)
    : last_bin_(static_cast<int>(std::ceil(range.forward_max_m / kRangeBin_m)) - 1) {}

int ProfileMeter::range_bin(const Point& sample) const {
  return std::min(static_cast<int>(std::floor(sample.x() / kRangeBin_m)), last_bin_);
}

void ProfileMeter::add(const FrameComparison& frame) {
  Moment moment{.stamp_ns = frame.stamp_ns};
  for (const MarkingType type : kMarkingTypes) {
    const KindComparison& comparison = frame.of(line_kind(type));
    add_truths(comparison, moment.score);
    add_predictions(comparison, type, moment.score);
  }
  over_time_.push_back(moment);
}

void ProfileMeter::add_truths(const KindComparison& comparison, SampleScore& moment) {
  const SampleGrid predictions(samples_of(comparison.predictions), kMatchDistance_m);
  for (const LinePiece& truth : comparison.truths) {
    for (const Point& sample : truth.samples) {
      const std::size_t found = has_near(predictions, sample) ? 1U : 0U;
      for (SampleScore* score : {&moment, &over_range_[range_bin(sample)]}) {
        ++score->truths;
        score->found += found;
      }
    }
  }
}

void ProfileMeter::add_predictions(const KindComparison& comparison, MarkingType type, SampleScore& moment) {
  const SampleGrid truths(samples_of(comparison.truths), kMatchDistance_m);
  std::vector<MeasuredPolyline> lines;
  lines.reserve(comparison.truths.size());
  for (const LinePiece& truth : comparison.truths) lines.emplace_back(truth.points);
  for (const LinePiece& prediction : comparison.predictions) {
    for (const Point& sample : prediction.samples) {
      const std::optional<double> error_m = lateral_error_m(truths, lines, sample);
      for (SampleScore* score : {&moment, &over_range_[range_bin(sample)]}) {
        ++score->predictions;
        score->right += error_m ? 1U : 0U;
        score->lateral_errors_m += error_m.value_or(0.0);
      }
      const double band = std::floor(sample.x() / kErrorBand_m);
      if (error_m && band >= 0.0 && band < static_cast<double>(kErrorBands))
        errors_[index(type)][static_cast<std::size_t>(band)].add(*error_m);
    }
  }
}

}  // namespace laneloom::evaluation
