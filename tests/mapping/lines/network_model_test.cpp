#include "mapping/lines/network_model.hpp"

#include <gtest/gtest.h>

#include <random>

namespace laneloom::lines {
namespace {

/// A network whose error is known; all places are at 0.
class LateralModel : public ::testing::Test {
 protected:
  double random() { return normal_(generator_); }
  FarView view(double range_m, double error_m, const PerSuspicion& suspected_m = PerSuspicion::Zero()) const {
    return {.source = 0, .range_m = range_m, .lateral_m = error_m, .suspected_m = suspected_m};
  }
  static double true_stddev_m(double range_m) { return 0.02 + 0.0001 * range_m * range_m; }

  FusionConfig config_;
  NetworkModel network_{config_};
  std::mt19937 generator_{1};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> range_m_{10.0, 48.0};
};

TEST_F(LateralModel, IsAsConfiguredAtFirst) {
  EXPECT_NEAR(network_.stddev_m(26.0), config_.stddev_m + 26.0 * config_.stddev_per_m, 1e-9);
  EXPECT_EQ(network_.stddev_m(0.0), network_.stddev_m(8.0));
  EXPECT_EQ(network_.stddev_m(90.0), network_.stddev_m(48.0));
  EXPECT_EQ(network_.gains(), PerSuspicion::Zero());
}

TEST_F(LateralModel, LearnsItsDeviationByRange) {
  for (int i = 0; i < 5000; ++i) {
    const double range_m = range_m_(generator_);
    network_.learn(view(range_m, true_stddev_m(range_m) * random()), 0.0);
  }
  for (const double range_m : {12.0, 18.0, 26.0, 36.0, 48.0})
    EXPECT_NEAR(network_.stddev_m(range_m), true_stddev_m(range_m), 0.2 * true_stddev_m(range_m)) << range_m;
}

TEST_F(LateralModel, AnOutlierCountsAsNoLargerThanALargeError) {
  const double before_m = network_.stddev_m(26.0);
  network_.learn(view(26.0, 50.0), 0.0);
  EXPECT_LT(network_.stddev_m(26.0), 1.1 * before_m);
}

TEST_F(LateralModel, StaysWithinItsBounds) {
  for (int i = 0; i < 100000; ++i) network_.learn(view(26.0, 0.0), 0.0);
  EXPECT_GE(network_.stddev_m(26.0), 0.02);
  for (int i = 0; i < 100000; ++i) network_.learn(view(26.0, i % 2 == 0 ? 50.0 : -50.0), 0.0);
  EXPECT_LE(network_.stddev_m(26.0), 1.0);
}

TEST_F(LateralModel, APitchThatComesTrueIsTakenOut) {
  for (int i = 0; i < 2000; ++i) {
    const double stretched_m = 0.1 * random();
    network_.learn(view(26.0, stretched_m + 0.05 * random(), {stretched_m, 0.0, 0.0}), 0.0);
  }
  EXPECT_GT(network_.gains()[kSuddenPitch], 0.9);
  EXPECT_NEAR(network_.stddev_m(26.0), 0.05, 0.01);  // of what is left
}

TEST_F(LateralModel, APitchThatDoesNotComeTrueIsLeft) {
  for (int i = 0; i < 2000; ++i) network_.learn(view(26.0, 0.05 * random(), {0.1 * random(), 0.0, 0.0}), 0.0);
  EXPECT_LT(network_.gains()[kSuddenPitch], 0.1);
}

TEST_F(LateralModel, EachSuspicionIsBelievedAsFarAsItComesTrueBesideTheOthers) {
  const PerSuspicion truth{1.0, 0.25, 0.5};
  for (int i = 0; i < 4000; ++i) {
    const PerSuspicion suspected_m = 0.1 * PerSuspicion(random(), random(), random());
    network_.learn(view(26.0, truth.dot(suspected_m) + 0.05 * random(), suspected_m), 0.0);
  }
  EXPECT_GT(network_.gains()[kSuddenPitch], 0.9);
  EXPECT_NEAR(network_.gains()[kLastingPitch], 0.25, 0.06);
  EXPECT_NEAR(network_.gains()[kPose], 0.5, 0.06);
}

TEST_F(LateralModel, ALastingPitchNeedsMoreViewsThanASuddenOne) {
  for (int i = 0; i < 100; ++i) network_.learn(view(26.0, 0.1, {0.05, 0.05, 0.0}), 0.0);
  EXPECT_GT(network_.gains()[kSuddenPitch], 1.5 * network_.gains()[kLastingPitch]);
}

TEST_F(LateralModel, ShowsWhatItLearned) {
  const NetworkProfile profile = network_.profile();
  EXPECT_EQ(profile.size(), NetworkModel::kNodes_m.size() + 3);
  EXPECT_NEAR(profile.at("stddev_at_8_m").value, network_.stddev_m(8.0), 1e-12);
  EXPECT_EQ(profile.at("alignment_gain"), LearnedValue{});
}

}  // namespace
}  // namespace laneloom::lines
