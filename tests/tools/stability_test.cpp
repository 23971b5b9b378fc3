#include "evaluation/stability.hpp"

#include <gtest/gtest.h>

#include "straight_lines.hpp"

namespace laneloom {
namespace {

evaluation::KindLine identified(double y, double from_x, double to_x, ElementId id = kNoElement) {
  return {.kind = evaluation::LineKind::laneline, .points = {{from_x, y, 0}, {to_x, y, 0}}, .id = id};
}

/// Drives along x, one frame per set of published lines, `step_m` apart.
evaluation::Stability drive(const std::vector<evaluation::KindLine>& truth,
                            const std::vector<std::vector<evaluation::KindLine>>& frames,
                            double step_m = 0.0) {
  evaluation::StabilityMeter meter(truth, kRange);
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  for (const std::vector<evaluation::KindLine>& lines : frames) {
    meter.add(compare(truth, lines, T_map_body, kRange), lines);
    T_map_body.translation().x() += step_m;
  }
  return meter.of(evaluation::LineKind::laneline);
}

TEST(Stability, APerfectMapDoesNotMove) {
  const std::vector<evaluation::KindLine> truth{identified(0, -20, 100, 7), identified(3, -20, 100, 8)};
  const evaluation::Stability stability = drive(truth, {truth, truth, truth}, 10.0);
  EXPECT_GT(stability.jitter_m.count(), 100u);
  EXPECT_NEAR(stability.jitter_m.quantile(1.0), 0.0, 1e-12);
  EXPECT_EQ(stability.id_switches, 0u);
  EXPECT_EQ(stability.flicker(), 0.0);
  EXPECT_EQ(stability.was_right, 4u);
  // From 5 m behind the first place to 30 m before the last: 55 m, of two lines.
  EXPECT_NEAR(stability.driven_past_m, 110.0, 1e-9);
}

TEST(Stability, JitterIsTheSidewaysStepInTheMapFrame) {
  // 0.1 m to the left, then 0.3 m to the right: of 35 m each, 36 places a frame.
  const evaluation::Stability stability =
      drive({identified(0, -20, 100)},
            {{identified(0, -20, 100)}, {identified(0.1, -20, 100)}, {identified(-0.2, -20, 100)}});
  EXPECT_EQ(stability.jitter_m.count(), 72u);
  EXPECT_NEAR(stability.jitter_m.quantile(0.5), 0.1, 1e-9);
  EXPECT_NEAR(stability.jitter_m.quantile(0.95), 0.3, 1e-9);
  EXPECT_NEAR(stability.jitter_m.mean(), 0.2, 1e-9);
}

TEST(Stability, JitterFrameByFrameIsTheMeanOfItsMarkings) {
  const std::vector<evaluation::KindLine> truth{identified(0, -20, 100), identified(5, -20, 100)};
  evaluation::StabilityMeter meter(truth, kRange);
  const std::vector<std::vector<evaluation::KindLine>> frames{
      {identified(0, -20, 100)},
      {identified(0.1, -20, 100), identified(5, -20, 100)},
      {identified(0.3, -20, 100), identified(5.1, -20, 100)},
      {}};
  for (const auto& lines : frames)
    meter.add(compare(truth, lines, Eigen::Isometry3d::Identity(), kRange), lines);
  const auto& jitter_m = meter.jitter_over_time_m();
  ASSERT_EQ(jitter_m.size(), 4u);
  EXPECT_FALSE(jitter_m[0]);
  EXPECT_NEAR(jitter_m[1].value(), 0.1, 1e-9) << "the second line was not there before";
  EXPECT_NEAR(jitter_m[2].value(), 0.15, 1e-9);
  EXPECT_FALSE(jitter_m[3]);
}

TEST(Stability, JitterComparesOnlyPlacesOfBoth) {
  // The second begins at x = -2 and has 33 places; the first ends at x = 25: those up to 25 remain.
  const evaluation::Stability stability =
      drive({identified(0, -20, 100)}, {{identified(0, -5, 25)}, {identified(0.1, -2, 30)}});
  EXPECT_EQ(stability.jitter_m.count(), 28u);
}

TEST(Stability, AnIdSwitchCountsAlsoAcrossAGap) {
  const evaluation::KindLine truth = identified(0, -20, 100);
  const evaluation::Stability stability = drive(
      {truth}, {{identified(0, -5, 30, 1)}, {}, {identified(0, -5, 30, 2)}, {identified(0, -5, 30, 2)}});
  EXPECT_EQ(stability.id_switches, 1u);
  EXPECT_NEAR(stability.driven_past_m, 35.0, 1e-9);
  EXPECT_NEAR(stability.id_switches_per_km(), 1000.0 / 35.0, 1e-9);
}

TEST(Stability, LinesWithoutIdsHaveNoSwitches) {
  const evaluation::KindLine truth = identified(0, -20, 100);
  EXPECT_FALSE(drive({truth}, {{identified(0, -5, 30)}, {identified(0, -5, 30)}}).has_ids);
}

TEST(Stability, FlickerIsRightThenWrong) {
  const evaluation::KindLine truth = identified(0, -20, 100);
  // right, wrong, right, right, right: of the three frames after a right one, one is wrong.
  const evaluation::Stability stability = drive({truth}, {{truth}, {}, {truth}, {truth}, {truth}});
  EXPECT_EQ(stability.was_right, 3u);
  EXPECT_NEAR(stability.flicker(), 1.0 / 3.0, 1e-12);
}

TEST(Stability, ALineThatLeavesTheRangeDoesNotFlicker) {
  const evaluation::KindLine truth = identified(0, -20, 20);
  const evaluation::Stability stability = drive({truth}, {{truth}, {}}, 100.0);
  EXPECT_EQ(stability.was_right, 0u);
}

}  // namespace
}  // namespace laneloom
