#include "evaluation/average_precision.hpp"

#include <gtest/gtest.h>

#include "straight_lines.hpp"

namespace laneloom {
namespace {

evaluation::KindLine scored(double y, double confidence = -1.0, ElementId id = kNoElement) {
  return {.kind = evaluation::LineKind::laneline,
          .points = {{0, y, 0}, {20, y, 0}},
          .id = id,
          .confidence = confidence};
}

evaluation::AveragePrecisionMeter measure(const std::vector<evaluation::KindLine>& truth,
                                          const std::vector<std::vector<evaluation::KindLine>>& frames) {
  evaluation::AveragePrecisionMeter meter;
  for (const std::vector<evaluation::KindLine>& lines : frames)
    meter.add(compare(truth, lines, Eigen::Isometry3d::Identity(), kRange), lines);
  return meter;
}

TEST(ChamferDistance, IsTheMeanOfBothDirections) {
  // From a: 0 and 4 to the nearest; from b: 0 and 0.
  EXPECT_DOUBLE_EQ(evaluation::chamfer_distance_m({{0, 0, 0}, {4, 0, 9}}, {{0, 0, 0}, {0, 0, 0}}), 1.0);
}

TEST(AveragePrecision, IsTheAreaUnderTheMonotonicCurve) {
  // right, wrong, right of 4 truths: precision 1 and 2/3 at the two steps of recall.
  EXPECT_NEAR(evaluation::average_precision({{0.5, true}, {0.9, true}, {0.7, false}}, 4),
              (1.0 + 2.0 / 3.0) / 4.0, 1e-12);
  // wrong, right, right: the second step's 2/3 also covers the first's 1/2.
  EXPECT_NEAR(evaluation::average_precision({{0.9, false}, {0.8, true}, {0.7, true}}, 2), 2.0 / 3.0, 1e-12);
  EXPECT_EQ(evaluation::average_precision({{0.9, false}}, 0), 0.0);
}

TEST(AveragePrecision, APerfectMapScoresPerfectly) {
  const std::vector<evaluation::KindLine> truth{scored(0, -1, 1), scored(4, -1, 2)};
  const evaluation::AveragePrecisionMeter meter = measure(truth, {truth, truth});
  EXPECT_DOUBLE_EQ(meter.map(), 1.0);
  EXPECT_DOUBLE_EQ(meter.c_map(), 1.0);
}

TEST(AveragePrecision, TheThresholdDecides) {
  const evaluation::AveragePrecisionMeter meter = measure({scored(0)}, {{scored(0.8)}});
  EXPECT_EQ(meter.ap(evaluation::LineKind::laneline, 0), 0.0);
  EXPECT_EQ(meter.ap(evaluation::LineKind::laneline, 1), 1.0);
  EXPECT_EQ(meter.ap(evaluation::LineKind::laneline, 2), 1.0);
  EXPECT_NEAR(meter.map(), 2.0 / 3.0, 1e-12);
}

TEST(AveragePrecision, TheMoreConfidentTakesTheTruth) {
  // The first in order is less sure: a false positive below the true one, which costs no area.
  EXPECT_EQ(
      measure({scored(0)}, {{scored(0.1, 0.3), scored(0.2, 0.9)}}).ap(evaluation::LineKind::laneline, 0),
      1.0);
  // A sure false positive does.
  EXPECT_EQ(measure({scored(0)}, {{scored(0.1, 0.3), scored(9, 0.9)}}).ap(evaluation::LineKind::laneline, 0),
            0.5);
}

TEST(AveragePrecision, AnotherIdIsInconsistent) {
  const evaluation::AveragePrecisionMeter meter =
      measure({scored(0)}, {{scored(0, 0.9, 1)}, {scored(0, 0.8, 2)}, {scored(0, 0.7, 1)}});
  EXPECT_EQ(meter.ap(evaluation::LineKind::laneline, 0), 1.0);
  // right, wrong, right of 3 truths.
  EXPECT_NEAR(meter.c_ap(evaluation::LineKind::laneline, 0), (1.0 + 2.0 / 3.0) / 3.0, 1e-12);
}

}  // namespace
}  // namespace laneloom
