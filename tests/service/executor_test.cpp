#include "service/executor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "milliseconds.hpp"

namespace laneloom::service {
namespace {

/// A clock that only moves when it is slept on, or when a task takes its time.
class SimulatedTime {
 public:
  explicit SimulatedTime(std::int64_t stop_ns) : stop_ns_(stop_ns) {}

  Timing timing() {
    return {[this] { return now_ns; },
            [this](std::int64_t deadline_ns) {
              now_ns = std::max(now_ns, deadline_ns + oversleep_ns);
              return now_ns < stop_ns_;
            },
            [] { return std::vector<std::int64_t>(); }};
  }

  std::int64_t now_ns = 7 * kMs;
  std::int64_t oversleep_ns = 0;

 private:
  std::int64_t stop_ns_;
};

std::vector<core::Tick> run(SimulatedTime& time, const std::function<std::int64_t(std::size_t)>& work_ns) {
  std::vector<core::Tick> ticks;
  run_periodically(100 * kMs, time.timing(), [&](const core::Tick& tick) {
    time.now_ns += work_ns(ticks.size());
    ticks.push_back(tick);
  });
  return ticks;
}

TEST(RunPeriodically, DeadlinesDoNotDrift) {
  SimulatedTime time(7 * kMs + 1000 * kMs);
  time.oversleep_ns = 3 * kMs;
  const auto ticks = run(time, [](std::size_t) { return 20 * kMs; });
  ASSERT_EQ(ticks.size(), 10U);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    EXPECT_EQ(ticks[i].deadline_ns, 7 * kMs + static_cast<std::int64_t>(i) * 100 * kMs);
    EXPECT_EQ(ticks[i].start_ns, ticks[i].deadline_ns + 3 * kMs);
    EXPECT_EQ(ticks[i].missed, 0U);
  }
}

TEST(RunPeriodically, ASlowTickMissesDeadlinesAndShiftsNone) {
  SimulatedTime time(7 * kMs + 1000 * kMs);
  const auto ticks = run(time, [](std::size_t i) { return i == 2 ? 250 * kMs : 10 * kMs; });
  ASSERT_EQ(ticks.size(), 8U);
  EXPECT_EQ(ticks[2].deadline_ns, 207 * kMs);
  EXPECT_EQ(ticks[3].deadline_ns, 507 * kMs);  // 307 and 407 passed while it ran
  EXPECT_EQ(ticks[3].missed, 2U);
  EXPECT_EQ(ticks[3].start_ns, 507 * kMs);
  EXPECT_EQ(ticks[4].deadline_ns, 607 * kMs);
  EXPECT_EQ(ticks[4].missed, 0U);
}

TEST(RunPeriodically, ATickAsLongAsThePeriodMissesNone) {
  SimulatedTime time(7 * kMs + 500 * kMs);
  const auto ticks = run(time, [](std::size_t) { return 100 * kMs; });
  ASSERT_EQ(ticks.size(), 5U);
  for (const auto& tick : ticks) EXPECT_EQ(tick.missed, 0U);
}

TEST(RunPeriodically, TicksWhenAFrameIsReady) {
  SimulatedTime time(7 * kMs + 1000 * kMs);
  Timing timing = time.timing();
  std::int64_t next_ns = 151 * kMs;
  timing.sleep_until = [&](std::int64_t deadline_ns) {
    time.now_ns = std::max(time.now_ns, std::min(deadline_ns, next_ns));
    return time.now_ns < 1000 * kMs;
  };
  timing.take_ready = [&] {
    std::vector<std::int64_t> ready_ns;
    for (; next_ns <= time.now_ns; next_ns += 100 * kMs) ready_ns.push_back(next_ns);
    return ready_ns;
  };
  std::vector<std::int64_t> starts_ms;
  run_periodically(100 * kMs, timing, [&](const core::Tick& tick) {
    starts_ms.push_back(tick.start_ns / kMs);
    EXPECT_EQ(tick.deadline_ns, tick.start_ns);
    time.now_ns += kMs;
  });
  EXPECT_EQ(starts_ms, (std::vector<std::int64_t>{7, 107, 251, 351, 451, 551, 651, 751, 851, 951}));
}

TEST(RunPeriodically, StopsWhenToldBeforeTheFirstTick) {
  SimulatedTime time(0);
  EXPECT_TRUE(run(time, [](std::size_t) { return kMs; }).empty());
}

}  // namespace
}  // namespace laneloom::service
