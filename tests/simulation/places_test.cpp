#include "simulation/places.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace laneloom::simulation {
namespace {

TEST(Places, AreTheSameFromTheSameSeedAndLineOnly) {
  const Places places(1, 5, 200.0, false), same(1, 5, 200.0, false);
  const Places other_seed(2, 5, 200.0, false), other_line(1, 6, 200.0, false);
  EXPECT_EQ(places.uniform(Trait::missed, 30.0), same.uniform(Trait::missed, 30.0));
  EXPECT_EQ(places.wave(Trait::offset, 30.0), same.wave(Trait::offset, 30.0));
  EXPECT_NE(places.uniform(Trait::missed, 30.0), other_seed.uniform(Trait::missed, 30.0));
  EXPECT_NE(places.uniform(Trait::missed, 30.0), other_line.uniform(Trait::missed, 30.0));
  EXPECT_NE(places.uniform(Trait::missed, 30.0), places.uniform(Trait::swapped, 30.0));
}

TEST(Places, AShareOfTheStretchesIsAmongThem) {
  int among = 0;
  constexpr int kLines = 2000;
  for (std::uint64_t line = 0; line < kLines; ++line)
    if (Places(3, line, 100.0, false).among(0.3, Trait::missed, 60.0)) ++among;
  EXPECT_NEAR(static_cast<double>(among) / kLines, 0.3, 0.04);
}

TEST(Places, AStretchIsOneUpToItsEnd) {
  const Places places(1, 1, 100.0, false);
  const double end_m = places.stretch_end_m(30.0);
  EXPECT_NEAR(end_m, 50.0, 1e-9);
  EXPECT_EQ(places.uniform(Trait::missed, 25.1), places.uniform(Trait::missed, end_m - 1e-3));
  EXPECT_NE(places.uniform(Trait::missed, 30.0), places.uniform(Trait::missed, end_m + 1e-3));
}

TEST(Places, AWaveHasAStandardDeviationOfOneAndNoSteps) {
  double squares = 0.0, largest_step = 0.0;
  int count = 0;
  for (std::uint64_t line = 0; line < 200; ++line) {
    const Places places(7, line, 500.0, false);
    double before = places.wave(Trait::offset, 0.0);
    for (double arc_m = 1.0; arc_m < 500.0; arc_m += 1.0, ++count) {
      const double now = places.wave(Trait::offset, arc_m);
      largest_step = std::fmax(largest_step, std::abs(now - before));
      squares += now * now;
      before = now;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.05);
  EXPECT_LT(largest_step, 0.5);
}

TEST(Places, OfARingGoOnOverItsSeam) {
  const Places ring(1, 1, 100.0, true);
  EXPECT_EQ(ring.uniform(Trait::missed, -10.0), ring.uniform(Trait::missed, 90.0));
  EXPECT_NEAR(ring.wave(Trait::offset, -1e-6), ring.wave(Trait::offset, 1e-6), 1e-3);
  EXPECT_NEAR(ring.wave(Trait::offset, 99.9999), ring.wave(Trait::offset, -0.0001), 1e-9);
}

TEST(Places, ALineWithoutLengthIsOnePlace) {
  const Places places(1, 1, 0.0, false);
  EXPECT_TRUE(std::isfinite(places.wave(Trait::offset, 0.0)));
  EXPECT_TRUE(places.among(1.0, Trait::missed, 0.0));
}

}  // namespace
}  // namespace laneloom::simulation
