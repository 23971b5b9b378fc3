#include "simulation/random.hpp"

#include <gtest/gtest.h>

namespace laneloom::simulation {
namespace {

TEST(Random, GivesTheSameNumbersEverywhere) {
  Random random(42);
  EXPECT_DOUBLE_EQ(random.uniform(), 0.75515553295453897);  // mt19937_64 is standardised
}

TEST(Random, NormalNumbersHaveUnitVariance) {
  Random random(1);
  double sum = 0.0, squares = 0.0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.02);
  EXPECT_NEAR(squares / kCount, 1.0, 0.02);
}

TEST(Wander, KeepsItsVarianceAndItsMemory) {
  Random random(2);
  Wander wander(random);
  double squares = 0.0, products = 0.0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const double before = wander.value();
    wander.step(0.1, 1.0, random);
    squares += before * before;
    products += before * wander.value();
  }
  EXPECT_NEAR(squares / kCount, 1.0, 0.06);
  EXPECT_NEAR(products / squares, 0.9, 0.01);
}

TEST(Switch, IsOnForItsShareAndDwells) {
  Random random(3);
  Switch state(0.2, random);
  int on = 0, switched_on = 0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const bool before = state.on();
    state.step(0.1, 0.2, 0.5, random);
    on += state.on() ? 1 : 0;
    switched_on += state.on() && !before ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(on) / kCount, 0.2, 0.01);
  EXPECT_NEAR(0.1 * on / switched_on, 0.5, 0.02) << "mean time that it stays on";
}

}  // namespace
}  // namespace laneloom::simulation
