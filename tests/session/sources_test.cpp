#include "session/sources.hpp"

#include <gtest/gtest.h>

namespace laneloom::session {
namespace {

constexpr std::int64_t kFrame_ns = 100'000'000;
constexpr std::int64_t kHour_ns = 3600 * std::int64_t{1'000'000'000};

DetectionFrame frame_at(std::int64_t stamp_ns, std::uint64_t session_id) {
  DetectionFrame frame;
  frame.stamp_ns = stamp_ns;
  frame.session_id = session_id;
  frame.source = "camera";
  return frame;
}

/// Fuses a frame if it is believed. Returns whether it begins a new session.
bool fuse(const DetectionFrame& frame, Sources& sources) {
  const Sources::Verdict verdict = sources.check(frame, frame.stamp_ns);
  if (verdict.refusal.empty()) sources.note_fused(frame, frame.stamp_ns);
  return verdict.restarted;
}

TEST(Sources, CountsOnAfterAJumpOfTheStamps) {
  Sources sources{GateConfig{}};
  for (int i = 1; i <= 5; ++i) fuse(frame_at(i * kFrame_ns, 7), sources);
  for (int i = 1; i <= 5; ++i)
    EXPECT_FALSE(fuse(frame_at(kHour_ns + i * kFrame_ns, 7), sources)) << "no new session";
  ASSERT_EQ(sources.progress().size(), 1U);
  EXPECT_EQ(sources.progress()[0].fused, 8U) << "the first two after the jump are outliers";
  EXPECT_EQ(sources.progress()[0].session_id, 7U);
}

TEST(Sources, ANewSessionCountsFromZero) {
  Sources sources{GateConfig{}};
  for (int i = 1; i <= 5; ++i) fuse(frame_at(i * kFrame_ns, 7), sources);
  EXPECT_TRUE(fuse(frame_at(6 * kFrame_ns, 8), sources));
  EXPECT_EQ(sources.progress()[0].fused, 1U);
  EXPECT_EQ(sources.progress()[0].session_id, 8U);
}

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(Sources, AreKnownByThePeriodOfTheirFrames) {
  Sources sources{GateConfig{}};
  const auto period_after = [&](std::int64_t arrival_ns) {
    EXPECT_EQ(sources.check(frame_at(arrival_ns, 7), arrival_ns).refusal, "");
    return sources.progress()[0].period_ns;
  };
  EXPECT_EQ(period_after(100 * kSecond_ns), kLongestPeriod_ns) << "one frame tells none";
  EXPECT_EQ(period_after(101 * kSecond_ns), kSecond_ns);
  EXPECT_EQ(period_after(101 * kSecond_ns + kFrame_ns), kFrame_ns);
  sources.check(frame_at(101 * kSecond_ns, 7), 102 * kSecond_ns);
  EXPECT_EQ(sources.progress()[0].period_ns, kFrame_ns) << "a repeated frame is no frame";
}

DetectionFrame frame_of(const std::string& source, std::int64_t stamp_ns) {
  DetectionFrame frame = frame_at(stamp_ns, 7);
  frame.source = source;
  return frame;
}

TEST(Sources, ANinthThatComesWhileEightGoOnIsRefusedSteadily) {
  Sources sources{GateConfig{}};
  const auto refusal = [&](const std::string& name, std::int64_t now_ns) {
    return sources.check(frame_of(name, now_ns), now_ns).refusal;
  };
  for (int i = 1; i <= 100; ++i) {
    for (int eighth = 1; eighth <= 8; ++eighth)
      EXPECT_EQ(refusal(std::to_string(eighth), i * kFrame_ns + eighth), "");
    EXPECT_EQ(refusal("ninth", i * kFrame_ns + 9), "too_many_sources");
    EXPECT_EQ(sources.crowded_out_ns(), i * kFrame_ns + 9);
  }
  EXPECT_EQ(sources.progress().size(), 8U);
}

// With its pid in the name, a stack that was restarted is another source.
TEST(Sources, ANewOneTakesThePlaceOfOneThatEnded) {
  Sources sources{GateConfig{}};
  for (int run = 1; run <= 100; ++run) {
    const std::int64_t now_ns = run * kSecond_ns;
    EXPECT_EQ(sources.check(frame_of("of run " + std::to_string(run), now_ns), now_ns).refusal, "") << run;
    EXPECT_EQ(sources.check(frame_of("steady", now_ns), now_ns).refusal, "");
    EXPECT_EQ(sources.check(frame_of("steady", now_ns), now_ns).refusal, "repeated") << "it is remembered";
  }
  EXPECT_EQ(sources.progress().size(), 8U);
  EXPECT_EQ(sources.check(frame_of("of run 1", kSecond_ns), 200 * kSecond_ns).refusal, "")
      << "what it sent is forgotten";
  EXPECT_FALSE(sources.crowded_out_ns());
}

}  // namespace
}  // namespace laneloom::session
