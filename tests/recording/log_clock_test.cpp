#include "recording/log_clock.hpp"

#include <gtest/gtest.h>

namespace laneloom::recording {
namespace {

TEST(LogClock, GoesOnEvenlyWhereTheSystemClockIsSet) {
  std::int64_t system_ns = 9'000'000, steady_ns = 50;
  LogClock clock([&] { return system_ns; }, [&] { return steady_ns; });
  EXPECT_EQ(clock.next(), 9'000'000);
  for (const std::int64_t set_to_ns : {1'000'000, 20'000'000}) {
    system_ns = set_to_ns;
    steady_ns += 700;
    EXPECT_EQ(clock.next(), 9'000'000 + steady_ns - 50);
  }
}

TEST(LogClock, NoTwoTimesAreEqual) {
  LogClock clock([] { return 9'000'000; }, [] { return 50; });
  for (std::int64_t i = 0; i < 5; ++i) EXPECT_EQ(clock.next(), 9'000'000 + i);
}

}  // namespace
}  // namespace laneloom::recording
