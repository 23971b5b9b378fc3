#include "evaluation/profile.hpp"

#include <gtest/gtest.h>

#include "straight_lines.hpp"

namespace laneloom {
namespace {

evaluation::ProfileMeter meter_of(const std::vector<evaluation::KindLine>& truth,
                                  const std::vector<evaluation::KindLine>& predictions) {
  evaluation::ProfileMeter meter(kRange);
  evaluation::FrameComparison frame = compare(truth, predictions, Eigen::Isometry3d::Identity(), kRange);
  frame.stamp_ns = 7;
  meter.add(frame);
  return meter;
}

TEST(Profile, SamplesFallIntoTheirRangeBins) {
  // The truth runs from -5 to 30 m; the prediction begins at 10 m, 0.2 m beside it.
  const evaluation::ProfileMeter meter = meter_of({straight(0, -50, 50)}, {straight(0.2, 10.02, 50)});
  ASSERT_EQ(meter.over_range().begin()->first, -1);
  EXPECT_EQ(meter.over_range().rbegin()->first, 5) << "the far end is in the last bin";
  EXPECT_EQ(meter.over_range().at(-1).truths, 50u);
  EXPECT_EQ(meter.over_range().at(1).found, 4u) << "of 5..10 m, what is 0.46 m before the prediction's start";
  EXPECT_EQ(meter.over_range().at(1).predictions, 0u);
  EXPECT_EQ(meter.over_range().at(1).precision(), 0.0);
  const evaluation::SampleScore& far = meter.over_range().at(3);
  EXPECT_EQ(far.recall(), 1.0);
  EXPECT_EQ(far.precision(), 1.0);
  EXPECT_NEAR(far.lateral_error_m(), 0.2, 1e-9) << "sideways, not to the nearest sample";
}

TEST(Profile, WhatIsTooFarOrOfAnotherKindIsWrong) {
  const evaluation::ProfileMeter meter = meter_of(
      {straight(0, -50, 50)}, {straight(0.6, -50, 50), straight(0, -50, 50, evaluation::LineKind::roadedge)});
  const evaluation::SampleScore& all = meter.over_time().at(0).score;
  EXPECT_EQ(all.precision(), 0.0);
  EXPECT_EQ(all.recall(), 0.0);
  EXPECT_EQ(all.lateral_error_m(), 0.0);
  EXPECT_EQ(all.predictions, 2 * all.truths);
}

TEST(Profile, APartOfALineIsRightThatIsNoTruePositive) {
  const evaluation::ProfileMeter meter = meter_of({straight(0, -50, 50)}, {straight(0, 0, 7)});
  ASSERT_EQ(meter.over_time().size(), 1u);
  EXPECT_EQ(meter.over_time()[0].stamp_ns, 7);
  EXPECT_EQ(meter.over_time()[0].score.precision(), 1.0);
  EXPECT_NEAR(meter.over_time()[0].score.recall(), 7.9 / 35.0, 0.005) << "0.5 m beyond both ends as well";
}

TEST(Profile, LanesAreNoMarkings) {
  const evaluation::ProfileMeter meter = meter_of({straight(0, -50, 50, evaluation::LineKind::lane)},
                                                  {straight(0, -50, 50, evaluation::LineKind::lane)});
  EXPECT_EQ(meter.over_time().at(0).score.truths, 0u);
  EXPECT_TRUE(meter.over_range().empty());
}

TEST(Profile, ErrorsOfEachTypeByBandsOfDistance) {
  // Predicted lines from the truth at 0 m: 0.1 m beside it behind 20 m, 0.3 m beside it beyond.
  const evaluation::ProfileMeter meter =
      meter_of({straight(0, -50, 50), straight(5, -50, 50, evaluation::LineKind::roadedge)},
               {straight(0.1, -50, 19.9), straight(0.3, 20.1, 50),
                straight(5.2, 0, 9.9, evaluation::LineKind::roadedge)});
  const auto& lanelines = meter.errors(MarkingType::laneline);
  EXPECT_NEAR(lanelines[0].quantile(0.5), 0.1, 1e-9);
  EXPECT_NEAR(lanelines[1].quantile(0.9), 0.1, 1e-9);
  EXPECT_NEAR(lanelines[2].quantile(0.5), 0.3, 1e-9);
  EXPECT_NEAR(static_cast<double>(lanelines[0].count()), 100.0, 1.0)
      << "what is behind the vehicle is left out";
  EXPECT_NEAR(meter.errors(MarkingType::roadedge)[0].quantile(0.9), 0.2, 1e-9);
  EXPECT_EQ(meter.errors(MarkingType::roadedge)[1].count(), 0u);
}

TEST(LateralErrors, QuantilesAreThoseOfTheCounts) {
  evaluation::LateralErrors errors;
  EXPECT_EQ(errors.quantile(0.5), 0.0);
  for (int i = 1; i <= 10; ++i) errors.add(0.01 * i);
  EXPECT_NEAR(errors.quantile(0.0), 0.01, 1e-12);
  EXPECT_NEAR(errors.quantile(0.5), 0.05, 1e-12);
  EXPECT_NEAR(errors.quantile(0.9), 0.09, 1e-12);
  EXPECT_NEAR(errors.quantile(1.0), 0.10, 1e-12);
}

}  // namespace
}  // namespace laneloom
