#include "evaluation/evaluation.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "evaluation/sample_grid.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::evaluation {
namespace {

constexpr double kSampleStep_m = 0.1;

/// A prediction that may be a truth line's true positive.
struct Candidate {
  std::size_t truth = 0;
  std::size_t prediction = 0;
  std::size_t matched = 0;  ///< samples of the prediction
  double chamfer_m = 0.0;
};

/// The lines of one kind, in the body frame, clipped to the range and sampled.
std::vector<LinePiece> pieces(const std::vector<KindLine>& lines, LineKind kind,
                              const Eigen::Isometry3d& T_body_map, const RangeConfig& range) {
  std::vector<LinePiece> pieces;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].kind != kind) continue;
    std::ranges::move(pieces_in_range(lines[i].points, i, T_body_map, range), std::back_inserter(pieces));
  }
  return pieces;
}

/// Adds the truth lines of which a prediction could be a true positive.
void add_candidates(const std::vector<LinePiece>& truths, const SampleGrid& grid, const Polyline& samples,
                    std::size_t prediction, std::vector<Candidate>& candidates) {
  const auto near = grid.nearness(samples);
  for (std::size_t truth = 0; truth < truths.size(); ++truth) {
    const auto matched = static_cast<double>(near[truth].count);
    if (matched > kMatchShare * static_cast<double>(truths[truth].samples.size()))
      candidates.push_back({truth, prediction, near[truth].count, near[truth].distances_m / matched});
  }
}

std::vector<TruePositive> match(const std::vector<LinePiece>& truths,
                                const std::vector<LinePiece>& predictions) {
  std::vector<Polyline> truth_samples;
  truth_samples.reserve(truths.size());
  for (const LinePiece& truth : truths) truth_samples.push_back(truth.samples);
  const SampleGrid grid(truth_samples, kMatchDistance_m);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < predictions.size(); ++i)
    add_candidates(truths, grid, predictions[i].samples, i, candidates);
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(b.matched, a.chamfer_m, a.truth, a.prediction) <
           std::tie(a.matched, b.chamfer_m, b.truth, b.prediction);
  });

  std::vector<TruePositive> matches;
  std::vector<bool> truth_used(truths.size()), prediction_used(predictions.size());
  for (const Candidate& candidate : candidates) {
    if (truth_used[candidate.truth] || prediction_used[candidate.prediction]) continue;
    truth_used[candidate.truth] = prediction_used[candidate.prediction] = true;
    matches.push_back({candidate.truth, candidate.prediction, candidate.chamfer_m});
  }
  return matches;
}

double ratio(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

}  // namespace

std::vector<LinePiece> pieces_in_range(const Polyline& points, std::size_t line,
                                       const Eigen::Isometry3d& T_body_map, const RangeConfig& range) {
  Polyline body(points.size());
  std::ranges::transform(points, body.begin(), [&](const Point& point) { return T_body_map * point; });
  std::vector<LinePiece> pieces;
  for (Polyline& piece : clip(body, range)) {
    Polyline samples = MeasuredPolyline(piece).resample(kSampleStep_m);
    pieces.push_back({line, std::move(piece), std::move(samples)});
  }
  return pieces;
}

std::optional<LinePiece> longest_piece_in_range(const Polyline& points, std::size_t line,
                                                const Eigen::Isometry3d& T_body_map,
                                                const RangeConfig& range) {
  std::vector<LinePiece> pieces = pieces_in_range(points, line, T_body_map, range);
  if (pieces.empty()) return std::nullopt;
  return std::move(
      *std::ranges::max_element(pieces, {}, [](const LinePiece& piece) { return piece.samples.size(); }));
}

const char* name(LineKind kind) {
  switch (kind) {
    case LineKind::laneline:
      return "laneline";
    case LineKind::roadedge:
      return "roadedge";
    case LineKind::stopline:
      return "stopline";
    case LineKind::lane:
      return "lane";
  }
  return "unknown";
}

double Score::precision() const {
  return ratio(static_cast<double>(matches), static_cast<double>(predictions));
}
double Score::recall() const { return ratio(static_cast<double>(matches), static_cast<double>(truths)); }
double Score::f1() const { return ratio(2.0 * precision() * recall(), precision() + recall()); }
double Score::acd_m() const { return ratio(chamfer_distances_m, static_cast<double>(matches)); }

Score& Score::operator+=(const Score& other) {
  truths += other.truths;
  predictions += other.predictions;
  matches += other.matches;
  chamfer_distances_m += other.chamfer_distances_m;
  return *this;
}

Score MapScore::markings() const {
  Score total;
  for (const MarkingType type : kMarkingTypes) total += of(line_kind(type));
  return total;
}

FrameComparison compare(const std::vector<KindLine>& truth, const std::vector<KindLine>& predictions,
                        const Eigen::Isometry3d& T_map_body, const RangeConfig& range) {
  const Eigen::Isometry3d T_body_map = T_map_body.inverse();
  FrameComparison frame;
  frame.T_map_body = T_map_body;
  for (std::size_t i = 0; i < kLineKindCount; ++i) {
    const auto kind = static_cast<LineKind>(i);
    KindComparison& comparison = frame.by_kind[i];
    comparison.truths = pieces(truth, kind, T_body_map, range);
    comparison.predictions = pieces(predictions, kind, T_body_map, range);
    comparison.matches = match(comparison.truths, comparison.predictions);
  }
  return frame;
}

void add(const FrameComparison& frame, MapScore& score) {
  for (std::size_t i = 0; i < kLineKindCount; ++i) {
    const KindComparison& comparison = frame.by_kind[i];
    Score added{comparison.truths.size(), comparison.predictions.size(), comparison.matches.size(), 0.0};
    for (const TruePositive& match : comparison.matches) added.chamfer_distances_m += match.chamfer_m;
    score.by_kind[i] += added;
  }
  ++score.frames;
}

std::vector<TruthOutcome> truth_outcomes(const KindComparison& comparison) {
  std::map<std::size_t, std::size_t> longest;  // piece of each line
  for (std::size_t piece = 0; piece < comparison.truths.size(); ++piece) {
    std::size_t& best = longest.emplace(comparison.truths[piece].line, piece).first->second;
    if (comparison.truths[piece].samples.size() > comparison.truths[best].samples.size()) best = piece;
  }
  std::vector<const LinePiece*> prediction_of(comparison.truths.size(), nullptr);
  for (const TruePositive& match : comparison.matches)
    prediction_of[match.truth] = &comparison.predictions[match.prediction];
  std::vector<TruthOutcome> outcomes;
  outcomes.reserve(longest.size());
  for (const auto& [line, piece] : longest) outcomes.push_back({line, prediction_of[piece]});
  return outcomes;
}

}  // namespace laneloom::evaluation
