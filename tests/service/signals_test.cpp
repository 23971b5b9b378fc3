#include "service/signals.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <thread>
#include <utility>

#include "base/clock.hpp"
#include "milliseconds.hpp"

namespace laneloom::service {
namespace {

constexpr std::int64_t kLong_ns = 60'000 * kMs;

TEST(Signals, SleepsUntilTheDeadline) {
  Signals signals;
  const auto deadline_ns = steady_now_ns() + 20 * kMs;
  EXPECT_EQ(signals.sleep_until(deadline_ns), Wake::deadline);
  EXPECT_GE(steady_now_ns(), deadline_ns);
  EXPECT_EQ(signals.sleep_until(deadline_ns), Wake::deadline);
}

TEST(Signals, WakeUpASleeper) {
  for (const auto& [signal, wake] :
       {std::pair(SIGHUP, Wake::reload), {SIGTERM, Wake::stop}, {SIGINT, Wake::stop}}) {
    Signals signals;
    kill(getpid(), signal);
    EXPECT_EQ(signals.sleep_until(steady_now_ns() + kLong_ns), wake);
  }
}

TEST(Signals, ACallWakesASleeperOnce) {
  Signals signals;
  signals.call();
  signals.call();
  EXPECT_EQ(signals.sleep_until(steady_now_ns() + kLong_ns), Wake::call);
  EXPECT_EQ(signals.sleep_until(steady_now_ns()), Wake::deadline);
  const std::jthread caller([&] { signals.call(); });
  EXPECT_EQ(signals.sleep_until(steady_now_ns() + kLong_ns), Wake::call);
}

TEST(SignalsDeathTest, EndAProcessThatIsToldToEndAndHangs) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(
      {
        Signals signals;
        kill(getpid(), SIGTERM);
        while (true) pause();
      },
      testing::ExitedWithCode(EXIT_FAILURE), "");
}

}  // namespace
}  // namespace laneloom::service
