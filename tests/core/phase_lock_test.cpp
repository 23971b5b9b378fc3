#include "core/phase_lock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "milliseconds.hpp"

// When ticks are due; src/README.md, "The phase of the ticks".
namespace laneloom::core {
namespace {

using testing::Each;
using testing::Ge;
using testing::Le;

constexpr std::int64_t kPeriod_ns = 100 * kMs;
constexpr std::int64_t kWork_ns = 2 * kMs;  // of a tick

/// A number in 0..1 that differs from index to index without a visible order.
double scattered(std::int64_t index) {
  return std::fmod(0.618033988749895 * static_cast<double>(index), 1.0);
}

/// What became of a row of frames.
struct Followed {
  std::vector<Tick> ticks;
  std::vector<double> waits_ms;  ///< of each frame, in the order of readiness, for its tick
};

/// Ticks until `end_ms`, while frames become ready at the given times.
Followed run(std::vector<std::int64_t> ready_ns, std::int64_t end_ms) {
  std::ranges::sort(ready_ns);
  Followed result;
  PhaseLock phase(kPeriod_ns, 0);
  std::size_t noted = 0;
  for (std::int64_t now_ns = 0; now_ns < end_ms * kMs;) {
    now_ns = std::max(now_ns, phase.deadline_ns());
    if (noted < ready_ns.size() && ready_ns[noted] <= now_ns) {
      now_ns = ready_ns[noted];
      phase.note_ready(ready_ns[noted++]);
      continue;
    }
    const Tick tick = phase.begin(now_ns);
    result.ticks.push_back(tick);
    while (result.waits_ms.size() < noted)
      result.waits_ms.push_back(static_cast<double>(now_ns - ready_ns[result.waits_ms.size()]) / kMs);
    now_ns += kWork_ns;
    phase.end(now_ns);
  }
  return result;
}

/// `count` frames from `first_ms` on, `jitter_ms` early or late.
std::vector<std::int64_t> frames(double first_ms, double period_ms, int count, double jitter_ms = 0.0) {
  std::vector<std::int64_t> ready_ns;
  for (int i = 0; i < count; ++i)
    ready_ns.push_back(
        std::llround((first_ms + period_ms * i + jitter_ms * (2.0 * scattered(i) - 1.0)) * kMs));
  return ready_ns;
}

std::vector<std::int64_t> together(std::vector<std::int64_t> a, const std::vector<std::int64_t>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The times between the starts of ticks from the `first` one on.
std::vector<double> steps_ms(const Followed& run, std::size_t first = 1) {
  std::vector<double> steps;
  for (std::size_t i = first; i < run.ticks.size(); ++i)
    steps.push_back(static_cast<double>(run.ticks[i].start_ns - run.ticks[i - 1].start_ns) / kMs);
  return steps;
}

/// The number of frames from the `first` one on that wait for longer than `limit_ms`.
std::ptrdiff_t waiting_longer(const Followed& run, double limit_ms, std::ptrdiff_t first = 0) {
  return std::count_if(run.waits_ms.begin() + first, run.waits_ms.end(),
                       [&](double wait_ms) { return wait_ms > limit_ms; });
}

TEST(PhaseLock, TicksFreelyWithoutFrames) { EXPECT_THAT(steps_ms(run({}, 2000)), Each(100.0)); }

TEST(PhaseLock, NoFrameButTheFirstWaits) {
  for (double first_ms = 1000.0; first_ms < 1100.0; first_ms += 7.0) {
    const Followed drive = run(frames(first_ms, 100.0, 100), 11'000);
    EXPECT_EQ(waiting_longer(drive, 0.0, 1), 0) << first_ms;
    EXPECT_LE(drive.waits_ms.front(), 100.0);
    EXPECT_NEAR(static_cast<double>(drive.ticks.size()), 110.0, 2.0) << "the period stays";
  }
}

TEST(PhaseLock, FramesThatAreEarlyOrLateDoNotWait) {
  const Followed drive = run(frames(1042.0, 100.0, 300, 12.0), 31'000);
  EXPECT_LE(waiting_longer(drive, 0.0), 1) << "the first one";
  EXPECT_NEAR(static_cast<double>(drive.ticks.size()), 310.0, 1.0);
  EXPECT_THAT(steps_ms(drive), Each(Ge(50.0)));
}

TEST(PhaseLock, MostFramesDoNotWaitThoughTheyAreEarlyOrLateByHalfAPeriod) {
  const Followed drive = run(frames(1042.0, 100.0, 300, 50.0), 31'000);
  EXPECT_LE(waiting_longer(drive, 0.0), 150);
  EXPECT_NEAR(static_cast<double>(drive.ticks.size()), 310.0, 20.0);
  EXPECT_THAT(steps_ms(drive), Each(Ge(50.0)));
  EXPECT_THAT(steps_ms(drive), Each(Le(200.0)));
}

TEST(PhaseLock, FollowsASourceWhosePeriodDiffersByATenth) {
  for (const double period_ms : {92.0, 99.9, 100.1, 108.0})
    EXPECT_LE(waiting_longer(run(frames(1033.0, period_ms, 200), 20'000), 0.0), 1) << period_ms;
}

TEST(PhaseLock, FramesThatAreLostUnlockNothing) {
  auto ready_ns = frames(1042.0, 100.0, 300, 5.0);
  std::int64_t index = 0;
  std::erase_if(ready_ns, [&](std::int64_t) { return scattered(7 * index++) < 0.3; });
  ready_ns.erase(ready_ns.begin() + 60, ready_ns.begin() + 66);
  EXPECT_LE(waiting_longer(run(ready_ns, 31'000), 0.0), 1);
}

TEST(PhaseLock, AFrameThatIsVeryLateHoldsUpTheNextOneAlone) {
  auto ready_ns = frames(1042.0, 100.0, 300);
  for (std::size_t i = 10; i < ready_ns.size(); i += 10) ready_ns[i] += 55 * kMs;
  const Followed drive = run(ready_ns, 31'000);
  EXPECT_EQ(waiting_longer(drive, 0.0, 1), 2 * 29);
  EXPECT_THAT(steps_ms(drive), Each(Le(180.0)));
}

TEST(PhaseLock, FollowsFramesOfAnotherPhaseAfterAFewPeriods) {
  for (const double jump_ms : {30.0, 50.0, 60.0, 3'600'040.0}) {
    const Followed drive = run(together(frames(1042.0, 100.0, 100), frames(11'042.0 + jump_ms, 100.0, 50)),
                               static_cast<std::int64_t>(16'000.0 + jump_ms));
    EXPECT_LE(waiting_longer(drive, 0.0, 1), 4) << jump_ms;
    EXPECT_THAT(steps_ms(drive), Each(Ge(50.0))) << jump_ms;
    EXPECT_THAT(steps_ms(drive), Each(Le(180.0))) << jump_ms;
  }
}

TEST(PhaseLock, WaitsForSourcesThatSendNearlyTogether) {
  const Followed drive =
      run(together(frames(1042.0, 100.0, 200, 2.0), frames(1050.0, 100.0, 200, 2.0)), 21'000);
  EXPECT_LE(waiting_longer(drive, 12.5), 4) << "the one for the other";
  EXPECT_NEAR(static_cast<double>(drive.ticks.size()), 210.0, 1.0);
}

TEST(PhaseLock, FollowsOneOfSeveralSourcesAndTheNextWhenThatEnds) {
  const Followed drive = run(together(frames(1042.0, 100.0, 100), frames(1082.0, 100.0, 200)), 21'000);
  EXPECT_LE(waiting_longer(drive, 60.5), 5) << "where the first one ends";
  EXPECT_LE(waiting_longer(drive, 0.0, 204), 0) << "the second source alone";
  EXPECT_NEAR(static_cast<double>(drive.ticks.size()), 210.0, 2.0);
}

TEST(PhaseLock, ThePeriodStaysHoweverManyFramesCome) {
  for (const double period_ms : {10.0, 25.0, 33.3, 50.0, 66.7, 200.0, 1000.0}) {
    const Followed drive = run(frames(1042.0, period_ms, static_cast<int>(20'000.0 / period_ms)), 21'000);
    EXPECT_NEAR(static_cast<double>(drive.ticks.size()), 210.0, 10.0) << period_ms;
    EXPECT_THAT(steps_ms(drive), Each(Ge(50.0))) << period_ms;
  }
}

TEST(PhaseLock, ASlowSourceIsFollowedToo) {
  for (const double period_ms : {200.0, 500.0, 1000.0})
    EXPECT_LE(waiting_longer(run(frames(1042.0, period_ms, 40, 5.0), 42'000), 0.0), 1) << period_ms;
}

TEST(PhaseLock, TicksFreelyASecondAfterTheLastFrame) {
  const Followed drive = run(frames(42.0, 100.0, 20), 6000);
  EXPECT_THAT(steps_ms(drive, 35), Each(100.0));
}

TEST(PhaseLock, NoTickIsNearAnotherThatCameLate) {
  PhaseLock phase(kPeriod_ns, 0);
  phase.begin(0);
  phase.end(kMs);
  phase.begin(180 * kMs);  // the host was busy
  phase.end(181 * kMs);
  EXPECT_EQ(phase.deadline_ns(), 230 * kMs);
  phase.note_ready(190 * kMs);
  EXPECT_GE(phase.deadline_ns(), 230 * kMs);
}

TEST(PhaseLock, WhatWasSleptThroughIsToldByTheFirstTickAfterwards) {
  PhaseLock phase(kPeriod_ns, 0);
  phase.begin(0);
  phase.end(kMs);
  const Tick late = phase.begin(2150 * kMs);  // the process was stopped
  EXPECT_EQ(late.deadline_ns, 100 * kMs);
  EXPECT_EQ(late.missed, 20U);
  phase.end(2151 * kMs);
  EXPECT_EQ(phase.deadline_ns(), 2200 * kMs);
  EXPECT_EQ(phase.begin(2200 * kMs).missed, 0U);
}

}  // namespace
}  // namespace laneloom::core
