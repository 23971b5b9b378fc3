#include "evaluation/trust.hpp"

#include <gtest/gtest.h>

#include "straight_lines.hpp"

namespace laneloom {
namespace {

evaluation::KindLine trusted(double y, double from_x, double to_x, double confidence = -1.0) {
  return {.kind = evaluation::LineKind::laneline,
          .points = {{from_x, y, 0}, {to_x, y, 0}},
          .confidence = confidence};
}

Eigen::Isometry3d at_x(double x) { return Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0)); }

TEST(Trust, CountsVerticesWithinTwoSigmaBesideTheTruth) {
  evaluation::KindLine line{.kind = evaluation::LineKind::laneline,
                            .points = {{-4, 0.1, 0}, {1, 0.1, 0}, {10, 0.3, 0}, {20, 0.1, 0}, {40, 0.1, 0}},
                            .lateral_stddev_m = {0.1, 0.1, 0.1, 0.06, 0.1}};
  // The first lies beyond the truth's end, the last out of range; 0.3 is more than 2 * 0.1.
  const std::vector<evaluation::KindLine> truth{trusted(0, 0, 50)}, lines{line};
  evaluation::TrustMeter meter(truth, kRange);
  meter.add(compare(truth, lines, at_x(0), kRange), lines);
  EXPECT_EQ(meter.markings().vertices, 3u);
  EXPECT_EQ(meter.markings().vertices_within_2_sigma, 2u);
}

TEST(Trust, CalibrationComparesConfidenceWithPrecision) {
  const std::vector<evaluation::KindLine> truth{trusted(0, 0, 20), trusted(4, 0, 20)};
  // 0.95 right, 0.75 right, 0.75 wrong, one that says nothing.
  const std::vector<evaluation::KindLine> lines{trusted(0, 0, 20, 0.95), trusted(4, 0, 20, 0.75),
                                                trusted(8, 0, 20, 0.75), trusted(12, 0, 20)};
  evaluation::TrustMeter meter(truth, kRange);
  meter.add(compare(truth, lines, at_x(0), kRange), lines);
  const evaluation::Trust trust = meter.markings();
  EXPECT_TRUE(trust.has_confidences());
  EXPECT_FALSE(evaluation::Trust().has_confidences());
  EXPECT_EQ(trust.calibration[7].count, 2u);
  EXPECT_DOUBLE_EQ(trust.calibration[7].precision(), 0.5);
  EXPECT_EQ(trust.calibration[9].count, 1u);
  EXPECT_NEAR(trust.expected_calibration_error(), (0.05 + 2 * 0.25) / 3.0, 1e-12);
}

TEST(Trust, WhatIsNoProbabilityIsNotCalibrated) {
  const std::vector<evaluation::KindLine> truth{trusted(0, 0, 20)};
  const std::vector<evaluation::KindLine> lines{trusted(0, 0, 20, 1e300), trusted(4, 0, 20, 1.0)};
  evaluation::TrustMeter meter(truth, kRange);
  meter.add(compare(truth, lines, at_x(0), kRange), lines);
  EXPECT_EQ(meter.markings().calibration[9].count, 1u);
  EXPECT_EQ(meter.markings().expected_calibration_error(), 1.0);
}

TEST(Trust, APerfectMapIsCertainAndRight) {
  std::vector<evaluation::KindLine> truth{trusted(0, 0, 20, 1.0)};
  truth[0].lateral_stddev_m = {0.0, 0.0};
  evaluation::TrustMeter meter(truth, kRange);
  meter.add(compare(truth, truth, at_x(0), kRange), truth);
  EXPECT_EQ(meter.markings().within_2_sigma(), 1.0);
  EXPECT_EQ(meter.markings().expected_calibration_error(), 0.0);
  EXPECT_EQ(meter.markings().first_appearance_s.quantile(1.0), 0.0);
  EXPECT_EQ(meter.markings().never_appeared, 0u);
}

TEST(Trust, FirstAppearanceCountsFromComingIntoRange) {
  // Comes into range at x = 10, where 30 m ahead is x = 40; found at x = 30.
  const std::vector<evaluation::KindLine> truth{trusted(0, 35, 60), trusted(5, 35, 60), trusted(5, 500, 600)};
  evaluation::TrustMeter meter(truth, kRange);
  for (int i = 0; i < 4; ++i) {
    const std::vector<evaluation::KindLine> lines =
        i == 3 ? std::vector<evaluation::KindLine>{truth[0]} : std::vector<evaluation::KindLine>{};
    evaluation::FrameComparison frame = compare(truth, lines, at_x(10.0 * i), kRange);
    frame.stamp_ns = i * 500'000'000LL;
    meter.add(frame, lines);
  }
  const evaluation::Trust trust = meter.markings();
  ASSERT_EQ(trust.first_appearance_s.count(), 1u);
  EXPECT_NEAR(trust.first_appearance_s.mean(), 1.0, 1e-9);
  EXPECT_NEAR(trust.first_appearance_m.mean(), 20.0, 1e-9);
  EXPECT_EQ(trust.never_appeared, 1u);  // the third never came into range
}

}  // namespace
}  // namespace laneloom
