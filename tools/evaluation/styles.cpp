#include "evaluation/styles.hpp"

#include "laneloom/polyline.hpp"

namespace laneloom::evaluation {
namespace {

constexpr double kStyleStep_m = 1.0;

MarkingStyle style_at(const KindLine& line, double arc_m) {
  for (const StyleRange& style : line.styles)
    if (arc_m <= style.range.to_m) return style.style;
  return line.styles.empty() ? MarkingStyle::unknown : line.styles.back().style;
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double StyleScore::accuracy() const { return share(right, right + wrong); }
double StyleScore::unknown_share() const { return share(unknown, right + wrong + unknown); }

void add_styles(const FrameComparison& frame, const std::vector<KindLine>& truth,
                const std::vector<KindLine>& predictions, StyleScore& score) {
  const KindComparison& lanelines = frame.of(LineKind::laneline);
  for (const TruePositive& match : lanelines.matches) {
    const KindLine& truth_line = truth[lanelines.truths[match.truth].line];
    const MarkingStyle expected = style_at(truth_line, 0.0);
    if (expected == MarkingStyle::unknown) continue;
    const LinePiece& piece = lanelines.predictions[match.prediction];
    const KindLine& prediction = predictions[piece.line];
    const MeasuredPolyline found(prediction.points), true_line(truth_line.points);
    for (const Point& sample : MeasuredPolyline(piece.points).resample(kStyleStep_m)) {
      const Point place = frame.T_map_body * sample;
      if (true_line.project(place).distance_m >= kMatchDistance_m) continue;
      const MarkingStyle style = style_at(prediction, found.project(place).arc_m);
      ++(style == MarkingStyle::unknown ? score.unknown : style == expected ? score.right : score.wrong);
    }
  }
}

}  // namespace laneloom::evaluation
