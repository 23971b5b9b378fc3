#include "service/time_window.hpp"

#include <gtest/gtest.h>

namespace laneloom::service {
namespace {

TEST(TimeWindow, IsZeroWhenEmpty) { EXPECT_EQ(TimeWindow(3).summary().max_ms, 0.0); }

TEST(TimeWindow, SummarisesWhatItHolds) {
  TimeWindow window(200);
  for (int i = 100; i >= 1; --i) window.add(i);
  const auto summary = window.summary();
  EXPECT_DOUBLE_EQ(summary.mean_ms, 50.5);
  EXPECT_EQ(summary.p50_ms, 50.0);
  EXPECT_EQ(summary.p99_ms, 99.0);
  EXPECT_EQ(summary.max_ms, 100.0);
}

TEST(TimeWindow, ForgetsTheOldest) {
  TimeWindow window(3);
  for (const double value : {100.0, 1.0, 2.0, 3.0}) window.add(value);
  EXPECT_EQ(window.summary().max_ms, 3.0);
  EXPECT_EQ(window.summary().mean_ms, 2.0);
}

}  // namespace
}  // namespace laneloom::service
