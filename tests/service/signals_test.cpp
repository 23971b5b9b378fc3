#include "service/signals.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "milliseconds.hpp"

namespace laneloom::service {
namespace {

constexpr std::int64_t kLong_ns = 60'000 * kMs;

TEST(Signals, SleepsUntilTheDeadline) {
  const Signals signals;
  const auto deadline_ns = steady_now_ns() + 20 * kMs;
  EXPECT_EQ(signals.sleep_until(deadline_ns), Wake::deadline);
  EXPECT_GE(steady_now_ns(), deadline_ns);
  EXPECT_EQ(signals.sleep_until(deadline_ns), Wake::deadline);
}

TEST(Signals, WakeUpASleeper) {
  const Signals signals;
  kill(getpid(), SIGTERM);
  EXPECT_EQ(signals.sleep_until(steady_now_ns() + kLong_ns), Wake::stop);
  kill(getpid(), SIGHUP);
  EXPECT_EQ(signals.sleep_until(steady_now_ns() + kLong_ns), Wake::reload);
  kill(getpid(), SIGINT);
  EXPECT_EQ(signals.sleep_until(steady_now_ns() + kLong_ns), Wake::stop);
}

}  // namespace
}  // namespace laneloom::service
