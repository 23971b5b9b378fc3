#include "core/health.hpp"

#include <gtest/gtest.h>

#include "milliseconds.hpp"

namespace laneloom::core {
namespace {

using Reasons = std::vector<StateReason>;

class HealthTest : public ::testing::Test {
 protected:
  /// When things arrived last, in milliseconds before now; negative: never.
  Verdict assess(int detections_ms, int poses_ms, int fused_ms) {
    const auto age_s = [](int ago_ms) { return ago_ms < 0 ? -1.0 : ago_ms / 1e3; };
    return health_.assess(now_ns_, {age_s(detections_ms), age_s(poses_ms), age_s(fused_ms)});
  }

  std::int64_t now_ns_ = 100'000 * kMs;
  Health health_{ServiceConfig{}};
};

TEST_F(HealthTest, OkWhileAllIsFresh) {
  EXPECT_EQ(assess(100, 10, 200), (Verdict{MapState::ok, {}}));
  EXPECT_EQ(assess(250, 250, 400), (Verdict{MapState::ok, {}}));
}

TEST_F(HealthTest, StaleAtTheStart) {
  EXPECT_EQ(
      assess(-1, -1, -1),
      (Verdict{MapState::stale, {StateReason::no_detections, StateReason::no_poses, StateReason::starting}}));
  EXPECT_EQ(assess(10, 10, -1), (Verdict{MapState::stale, {StateReason::starting}}));
}

TEST_F(HealthTest, DegradedWhenAnInputIsMissing) {
  EXPECT_EQ(assess(251, 10, 300), (Verdict{MapState::degraded, {StateReason::no_detections}}));
  EXPECT_EQ(assess(10, 251, 100), (Verdict{MapState::degraded, {StateReason::no_poses}}));
}

TEST_F(HealthTest, StaleWhenNothingWasFusedForLong) {
  EXPECT_EQ(assess(500, 10, 500), (Verdict{MapState::stale, {StateReason::no_detections}}));
  EXPECT_EQ(assess(10, 10, 401), (Verdict{MapState::stale, {StateReason::unsynchronised}}));
}

TEST_F(HealthTest, IncidentsDegradeForASecond) {
  health_.note_unsynchronised(now_ns_);
  health_.note_overload(now_ns_);
  health_.note_pose_jump(now_ns_);
  EXPECT_EQ(assess(0, 0, 0),
            (Verdict{MapState::degraded,
                     {StateReason::unsynchronised, StateReason::overloaded, StateReason::poses_jumped}}));
  now_ns_ += 1000 * kMs;
  EXPECT_EQ(assess(0, 0, 0).state, MapState::degraded);
  now_ns_ += 1 * kMs;
  EXPECT_EQ(assess(0, 0, 0), (Verdict{MapState::ok, {}}));
}

TEST_F(HealthTest, SourcesThatDisagreeDegrade) {
  HealthInputs inputs{
      .detections_age_s = 0.0, .poses_age_s = 0.0, .fused_age_s = 0.0, .sources_disagree = true};
  EXPECT_EQ(health_.assess(now_ns_, inputs), (Verdict{MapState::degraded, {StateReason::sources_disagree}}));
  inputs.fused_age_s = 1.0;
  EXPECT_EQ(health_.assess(now_ns_, inputs), (Verdict{MapState::stale, {StateReason::sources_disagree}}))
      << "the one that is left out is alone";
  inputs.detections_age_s = 1.0;
  EXPECT_EQ(health_.assess(now_ns_, inputs), (Verdict{MapState::stale, {StateReason::no_detections}}));
}

TEST_F(HealthTest, AResetIsSaidForASecond) {
  health_.note_reset(now_ns_);
  EXPECT_EQ(assess(0, 0, -1), (Verdict{MapState::stale, {StateReason::reset}}));
  now_ns_ += 1001 * kMs;
  EXPECT_EQ(assess(0, 0, -1), (Verdict{MapState::stale, {StateReason::starting}}));
  EXPECT_EQ(assess(0, 0, 0), (Verdict{MapState::ok, {}}));
}

// Frames come and are fused at once, but their stamps lie behind those of the poses.
TEST_F(HealthTest, FramesThatAreOldByTheirStampsMakeItOutdated) {
  const auto lag = [&](double lag_s) { return health_.assess(now_ns_, {0.0, 0.0, 0.0, -1.0, lag_s}); };
  EXPECT_EQ(lag(0.5), (Verdict{MapState::ok, {}}));
  EXPECT_EQ(lag(0.51), (Verdict{MapState::degraded, {StateReason::outdated}}));
  EXPECT_EQ(lag(1.0), (Verdict{MapState::degraded, {StateReason::outdated}}));
  EXPECT_EQ(lag(1.01), (Verdict{MapState::stale, {StateReason::outdated}}));
  EXPECT_EQ(lag(-0.1), (Verdict{MapState::ok, {}}));
}

TEST_F(HealthTest, ASourceThatIsNotFusedDegradesTheMapOfTheOthers) {
  const auto fused_ago = [&](double ago_s) {
    return health_.assess(now_ns_, {.detections_age_s = 0.0,
                                    .poses_age_s = 0.0,
                                    .fused_age_s = ago_s,
                                    .lag_s = 0.1,
                                    .source_not_fused = true});
  };
  EXPECT_EQ(fused_ago(0.1), (Verdict{MapState::degraded, {StateReason::source_not_fused}}));
  EXPECT_EQ(fused_ago(0.5), (Verdict{MapState::stale, {StateReason::unsynchronised}})) << "none is";
}

TEST_F(HealthTest, ADrivingSideThatTrafficContradictsIsSaid) {
  const auto fused_ago = [&](double ago_s) {
    return health_.assess(now_ns_, {.detections_age_s = 0.0,
                                    .poses_age_s = 0.0,
                                    .fused_age_s = ago_s,
                                    .lag_s = 0.1,
                                    .driving_side_contradicted = true});
  };
  EXPECT_EQ(fused_ago(0.1), (Verdict{MapState::degraded, {StateReason::driving_side_contradicted}}));
  EXPECT_EQ(fused_ago(0.5), (Verdict{MapState::stale, {StateReason::unsynchronised}})) << "nothing is fused";
}

TEST_F(HealthTest, AnotherServiceIsSaidForAsLongAsItIsHeard) {
  const auto heard_ago = [&](double ago_s) { return health_.assess(now_ns_, {0.0, 0.0, 0.0, ago_s}); };
  EXPECT_EQ(heard_ago(2.5), (Verdict{MapState::degraded, {StateReason::another_service}}));
  EXPECT_EQ(heard_ago(2.501), (Verdict{MapState::ok, {}}));
}

TEST(Age, IsMinusOneBeforeTheFirst) {
  EXPECT_EQ(age_s(5, std::nullopt), -1.0);
  EXPECT_DOUBLE_EQ(age_s(1'500 * kMs, 1'000 * kMs), 0.5);
}

}  // namespace
}  // namespace laneloom::core
