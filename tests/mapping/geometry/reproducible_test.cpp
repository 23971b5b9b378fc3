#include "mapping/geometry/reproducible.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace laneloom::geometry::reproducible {
namespace {

constexpr int kValues = 100'000;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The error of a value in units in its last place.
double units(double value, long double right) {
  const double size = std::abs(static_cast<double>(right));
  return static_cast<double>(std::abs(value - right) / (std::nextafter(size, kInfinity) - size));
}

/// Even over a range, and the same on every host.
class Values {
 public:
  double within(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11U) / 9007199254740992.0;
  }

 private:
  std::mt19937_64 generator_{1};
};

TEST(Reproducible, ExponentialsAreThoseOfTheLibrary) {
  Values values;
  for (int i = 0; i < kValues; ++i) {
    const double x = values.within(-700.0, 700.0);
    ASSERT_LT(units(exp(x), std::exp(static_cast<long double>(x))), 1.0) << x;
  }
  EXPECT_EQ(exp(0.0), 1.0);
  EXPECT_EQ(exp(-1000.0), 0.0);
  EXPECT_EQ(exp(-kInfinity), 0.0);
  EXPECT_EQ(exp(1000.0), kInfinity);
  EXPECT_TRUE(std::isnan(exp(std::nan(""))));
}

TEST(Reproducible, LogarithmsAreThoseOfTheLibrary) {
  Values values;
  for (int i = 0; i < kValues; ++i) {
    for (const double x : {values.within(1e-9, 2.0), exp(values.within(-300.0, 300.0))})
      ASSERT_LT(units(log(x), std::log(static_cast<long double>(x))), 1.0) << x;
  }
  EXPECT_EQ(log(1.0), 0.0);
  EXPECT_EQ(log(0.0), -kInfinity);
  EXPECT_EQ(log(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(log(-1.0)));
  EXPECT_TRUE(std::isnan(log(std::nan(""))));
}

TEST(Reproducible, AnglesAreThoseOfTheLibrary) {
  constexpr double kError = 3e-16;
  Values values;
  for (int i = 0; i < kValues; ++i) {
    const double angle = values.within(-10.0, 10.0), x = values.within(-1.0, 1.0),
                 y = values.within(-1.0, 1.0);
    ASSERT_NEAR(sin(angle), std::sin(angle), kError) << angle;
    ASSERT_NEAR(cos(angle), std::cos(angle), kError) << angle;
    ASSERT_NEAR(atan2(y, x), std::atan2(y, x), 2.0 * kError) << y << " " << x;
  }
  for (const double y : {0.0, -0.0, 1.0, -1.0})
    for (const double x : {0.0, -0.0, 1.0, -1.0}) {
      EXPECT_EQ(atan2(y, x), std::atan2(y, x)) << y << " " << x;
      EXPECT_EQ(std::signbit(atan2(y, x)), std::signbit(std::atan2(y, x))) << y << " " << x;
    }
}

}  // namespace
}  // namespace laneloom::geometry::reproducible
