#include "evaluation/average_precision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "laneloom/polyline.hpp"

namespace laneloom::evaluation {
namespace {

constexpr std::size_t kPoints = 100;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Resampled {
  Polyline points;
  Eigen::AlignedBox2d box;
};

Resampled resampled(const LinePiece& piece) {
  const MeasuredPolyline line(piece.points);
  Resampled result;
  for (std::size_t i = 0; i < kPoints; ++i) {
    result.points.push_back(line.at(line.length() * static_cast<double>(i) / (kPoints - 1)));
    result.box.extend(Eigen::Vector2d(result.points.back().head<2>()));
  }
  return result;
}

struct Nearest {
  std::size_t truth = 0;
  double distance_m = kInfinity;
};

/// The nearest truth line. Lines whose boxes are too far apart are skipped, because no line is nearer to
/// another than their boxes are.
Nearest nearest(const Resampled& prediction, const std::vector<Resampled>& truths) {
  Nearest best;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    if (prediction.box.exteriorDistance(truths[i].box) > kApThresholds_m.back()) continue;
    const double distance_m = chamfer_distance_m(prediction.points, truths[i].points);
    if (distance_m < best.distance_m) best = {i, distance_m};
  }
  return best;
}

double confidence(const KindLine& line) { return line.confidence < 0.0 ? 1.0 : line.confidence; }

}  // namespace

double chamfer_distance_m(const Polyline& a, const Polyline& b) {
  std::vector<double> from_a(a.size(), kInfinity), from_b(b.size(), kInfinity);  // squared
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double squared = (a[i] - b[j]).head<2>().squaredNorm();
      from_a[i] = std::min(from_a[i], squared);
      from_b[j] = std::min(from_b[j], squared);
    }
  }
  const auto mean = [](const std::vector<double>& squares) {
    double sum = 0.0;
    for (const double square : squares) sum += std::sqrt(square);
    return sum / static_cast<double>(squares.size());
  };
  return 0.5 * (mean(from_a) + mean(from_b));
}

double average_precision(std::vector<RatedLine> lines, std::size_t truths) {
  if (truths == 0) return 0.0;
  std::stable_sort(lines.begin(), lines.end(),
                   [](const RatedLine& a, const RatedLine& b) { return a.confidence > b.confidence; });
  std::vector<double> precisions;
  double right = 0.0;
  for (const RatedLine& line : lines) {
    right += line.right ? 1.0 : 0.0;
    precisions.push_back(right / static_cast<double>(precisions.size() + 1));
  }
  double area = 0.0, best = 0.0;
  for (std::size_t i = lines.size(); i-- > 0;) {
    best = std::max(best, precisions[i]);
    if (lines[i].right) area += best;  // each true positive is one step of recall
  }
  return area / static_cast<double>(truths);
}

void AveragePrecisionMeter::add_kind(const KindComparison& comparison,
                                     const std::vector<KindLine>& predictions, KindState& state) {
  state.truths += comparison.truths.size();
  std::vector<Resampled> truths;
  for (const LinePiece& truth : comparison.truths) truths.push_back(resampled(truth));
  std::vector<const LinePiece*> order;
  for (const LinePiece& prediction : comparison.predictions) order.push_back(&prediction);
  std::stable_sort(order.begin(), order.end(), [&](const LinePiece* a, const LinePiece* b) {
    return confidence(predictions[a->line]) > confidence(predictions[b->line]);
  });

  std::array<std::vector<bool>, kApThresholds_m.size()> taken;
  taken.fill(std::vector<bool>(truths.size()));
  for (const LinePiece* prediction : order) {
    const KindLine& line = predictions[prediction->line];
    has_ids_ = has_ids_ || line.id != kNoElement;
    const auto [truth, distance_m] = nearest(resampled(*prediction), truths);
    for (std::size_t t = 0; t < kApThresholds_m.size(); ++t) {
      ThresholdState& threshold = state.thresholds[t];
      const bool right = distance_m <= kApThresholds_m[t] && !taken[t][truth];
      bool consistent = right;
      if (right) {
        taken[t][truth] = true;
        const auto first = threshold.id_of_truth.emplace(comparison.truths[truth].line, line.id).first;
        consistent = first->second == line.id;
      }
      threshold.rated.push_back({confidence(line), right});
      threshold.consistent.push_back({confidence(line), consistent});
    }
  }
}

void AveragePrecisionMeter::add(const FrameComparison& frame, const std::vector<KindLine>& predictions) {
  for (std::size_t i = 0; i < kLineKindCount; ++i) add_kind(frame.by_kind[i], predictions, kinds_[i]);
}

void AveragePrecisionMeter::add(const AveragePrecisionMeter& other) {
  const auto append = [](const std::vector<RatedLine>& from, std::vector<RatedLine>& to) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (std::size_t i = 0; i < kLineKindCount; ++i) {
    kinds_[i].truths += other.kinds_[i].truths;
    for (std::size_t t = 0; t < kApThresholds_m.size(); ++t) {
      append(other.kinds_[i].thresholds[t].rated, kinds_[i].thresholds[t].rated);
      append(other.kinds_[i].thresholds[t].consistent, kinds_[i].thresholds[t].consistent);
    }
  }
  has_ids_ = has_ids_ || other.has_ids_;
}

double AveragePrecisionMeter::ap(LineKind kind, std::size_t threshold) const {
  const KindState& state = kinds_[index(kind)];
  return average_precision(state.thresholds[threshold].rated, state.truths);
}

double AveragePrecisionMeter::c_ap(LineKind kind, std::size_t threshold) const {
  const KindState& state = kinds_[index(kind)];
  return average_precision(state.thresholds[threshold].consistent, state.truths);
}

double AveragePrecisionMeter::mean_over_markings(double (AveragePrecisionMeter::*measure)(LineKind,
                                                                                          std::size_t)
                                                     const) const {
  double sum = 0.0;
  std::size_t terms = 0;
  for (const MarkingType type : kMarkingTypes) {
    if (truths(line_kind(type)) == 0) continue;
    for (std::size_t t = 0; t < kApThresholds_m.size(); ++t, ++terms)
      sum += (this->*measure)(line_kind(type), t);
  }
  return terms == 0 ? 0.0 : sum / static_cast<double>(terms);
}

}  // namespace laneloom::evaluation
