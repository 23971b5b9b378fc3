#include "mapping/lines/lateral_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

namespace laneloom::lines {
namespace {

constexpr double kDrift_m2_per_m = 1.5e-3;  // as the filter assumes of the poses

/// A place and its views, all on one axis; the vehicle drives along the other one.
class Place : public ::testing::Test {
 protected:
  void see(double at_m, double stddev_m, double driven_m) {
    const LateralView view{at_m - estimate_m_, stddev_m, {driven_m, 0.0}, stamp_ns_};
    if (std::exchange(seen_, true)) {
      estimate_m_ += filter_.update(view);
    } else {
      estimate_m_ = at_m;
      filter_ = LateralFilter(view);
    }
  }
  double stddev_m() const { return std::sqrt(filter_.variance_m2()); }

  std::int64_t stamp_ns_ = 0;
  double estimate_m_ = 0.0;
  bool seen_ = false;
  LateralFilter filter_;
};

TEST_F(Place, IsKnownAsWellAsItsOneView) {
  see(0.3, 0.2, 0.0);
  EXPECT_NEAR(stddev_m(), 0.2, 1e-12);
}

TEST_F(Place, ANearViewDecidesAgainstManyFarOnes) {
  for (int i = 0; i < 12; ++i) see(0.2, 0.15, 3.0 * i);
  see(0.0, 0.03, 39.0);
  EXPECT_LT(std::abs(estimate_m_), 0.03);
  EXPECT_LT(stddev_m(), 0.035);
}

TEST_F(Place, IsNeverKnownWorseThanByItsBestViewAndWhatThePosesDriftedSince) {
  double best_m2 = 1.0;
  const double step_m = 0.3;
  for (int i = 0; i < 30; ++i) {
    const double deviation_m = 0.03 + 0.1 * std::abs(std::sin(i));
    best_m2 = std::min(best_m2 + kDrift_m2_per_m * step_m, deviation_m * deviation_m);
    see(0.05 * std::cos(3.0 * i), deviation_m, step_m * i);
    EXPECT_LE(stddev_m(), std::sqrt(best_m2) + 1e-3) << i;
  }
}

TEST_F(Place, AStandingVehicleLearnsHardlyMore) {
  for (int i = 0; i < 1000; ++i) see(0.1, 0.2, 0.0);
  EXPECT_GT(stddev_m(), 0.9 * 0.2);
}

TEST_F(Place, AVehicleThatStandsForSecondsFollowsWhatItSees) {
  for (int i = 0; i < 40; ++i) see(0.4, 0.1, 1.0 * i);
  for (int i = 0; i < 100; ++i) {
    stamp_ns_ += 100'000'000;
    see(0.0, 0.1, 39.0);
  }
  EXPECT_LT(estimate_m_, 0.2);
}

TEST_F(Place, ViewsOfOneMomentDoNotFade) {
  stamp_ns_ = 5'000'000'000;
  see(0.1, 0.2, 0.0);
  for (int i = 0; i < 100; ++i) {
    stamp_ns_ = i % 2 == 0 ? 4'900'000'000 : 5'000'000'000;  // of two sources, of which one is late
    see(0.1, 0.2, 0.0);
  }
  EXPECT_GT(stddev_m(), 0.9 * 0.2);
}

TEST_F(Place, ViewsThatHaveNothingInCommonAverage) {
  for (int i = 0; i < 16; ++i) {
    stamp_ns_ += 10'000'000'000;
    see(i % 2 == 0 ? 0.2 : -0.2, 0.2, 0.0);
  }
  EXPECT_LT(stddev_m(), 0.35 * 0.2);
  EXPECT_NEAR(estimate_m_, 0.0, 0.03);
}

TEST(LateralFilter, SeenFromTheOtherSideItIsMirrored) {
  const auto view = [](double lateral_m, double x, double stddev_m) {
    return LateralView{.lateral_m = lateral_m, .stddev_m = stddev_m, .seen_from = {x, 0.0}, .stamp_ns = 0};
  };
  LateralFilter filter(view(0.0, 0.0, 0.3)), mirrored(view(0.0, 0.0, 0.3));
  EXPECT_DOUBLE_EQ(filter.update(view(0.4, 1.0, 0.2)), mirrored.update(view(0.4, 1.0, 0.2)));
  mirrored.mirror();
  EXPECT_DOUBLE_EQ(filter.update(view(0.3, 2.0, 0.1)), -mirrored.update(view(-0.3, 2.0, 0.1)));
  EXPECT_DOUBLE_EQ(filter.variance_m2(), mirrored.variance_m2());
}

TEST_F(Place, ErrsAsMuchAsItSays) {
  constexpr double kShared = 0.9, kCorrelation_m = 5.0;
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  const double step_m = 3.0, kept = std::exp(-step_m / kCorrelation_m);
  double sum = 0.0;
  const int places = 2000;
  for (int place = 0; place < places; ++place) {
    seen_ = false;
    double error = normal(generator), drifted_m = 0.0;
    for (int i = 0; i < 12; ++i) {
      const double stddev_m = 0.15 - 0.01 * i;
      const double fresh = std::sqrt(1.0 - kShared) * normal(generator);
      see(drifted_m + stddev_m * (std::sqrt(kShared) * error + fresh), stddev_m, step_m * i);
      error = kept * error + std::sqrt(1.0 - kept * kept) * normal(generator);
      if (i < 11) drifted_m += std::sqrt(kDrift_m2_per_m * step_m) * normal(generator);
    }
    const double error_m = estimate_m_ - drifted_m;
    sum += error_m * error_m / filter_.variance_m2();
  }
  EXPECT_NEAR(sum / places, 1.0, 0.1);
}

}  // namespace
}  // namespace laneloom::lines
