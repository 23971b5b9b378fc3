#include <gtest/gtest.h>

#include <algorithm>

#include "simulated_drive.hpp"

// Whatever the mapper does, a tick keeps its time; deploy/README.md, "When things go wrong".
namespace laneloom::service {
namespace {

using States = std::vector<std::string>;

constexpr double kLease_s = 0.4;  // of the map's liveliness

/// The longest time between two maps.
double longest_gap_s(const SimulatedDrive& drive) {
  std::int64_t longest_ns = 0;
  for (std::size_t i = 1; i < drive.maps().size(); ++i)
    longest_ns = std::max(longest_ns, drive.maps()[i].published_ns - drive.maps()[i - 1].published_ns);
  return static_cast<double>(longest_ns) / 1e9;
}

std::uint64_t pending(const SimulatedDrive& drive) { return drive.statuses().back().pending_frames; }

TEST(Overload, ABurstOfSlowFramesIsSpreadOverTicks) {
  SimulatedDrive drive;
  drive.run_for(1000);
  drive.fusion_ms = 90;
  drive.send_frames = bunch<DetectionFrame>(3);
  drive.run_for(3000);
  EXPECT_LT(longest_gap_s(drive), 0.2);
  EXPECT_EQ(drive.fused().size(), 28U) << "every one";
  for (const PublishedMap& map : drive.maps()) EXPECT_LE(map.fused_frames.size(), 1U);
  EXPECT_EQ(drive.counter("ticks_missed"), 0U);
  EXPECT_GT(drive.counter("ticks_out_of_time"), 10U);
  EXPECT_EQ(drive.state(), "DEGRADED overloaded");
  drive.fusion_ms = 0;
  drive.send_frames = {};
  drive.run_for(2000);
  EXPECT_EQ(drive.states(), (States{"DEGRADED overloaded", "OK"}));
}

TEST(Overload, ATickEndsInTimeForItsMapHoweverManyFramesWait) {
  SimulatedDrive drive(Config{}, 10);
  drive.fusion_ms = 30;
  drive.run_for(10'000);
  EXPECT_EQ(drive.maps().size(), 100U) << "a map at every tick";
  EXPECT_LT(longest_gap_s(drive), kLease_s);
  EXPECT_EQ(drive.counter("ticks_missed"), 0U);
  for (const PublishedMap& map : drive.maps()) EXPECT_LE(map.fused_frames.size(), 2U) << "half a period";
  EXPECT_GT(drive.counter("frames_dropped_queue_full"), 500U);
  EXPECT_LE(pending(drive), 64U);
  const auto frames = drive.fused();
  EXPECT_TRUE(std::ranges::is_sorted(frames, {}, &FusedFrame::stamp_ns)) << "the oldest first";
}

TEST(Overload, EveryFrameIsFusedDroppedOrWaits) {
  SimulatedDrive drive(Config{}, 10);
  drive.fusion_ms = 30;
  drive.run_for(10'000);
  // The newest status is of its own instant.
  EXPECT_EQ(drive.counter("detections_received"),
            drive.counter("frames_fused") + drive.counter("frames_dropped_queue_full") +
                drive.counter("detections_refused_unsynchronised") + pending(drive));
}

TEST(Overload, AFrameThatTakesLongerThanATickHoldsUpOneTickAlone) {
  SimulatedDrive drive;
  drive.run_for(1000);
  drive.fusion_ms = 250;
  drive.run_for(5000);
  EXPECT_LT(longest_gap_s(drive), kLease_s);
  EXPECT_GT(drive.fused().size(), 15U) << "one at least in each tick";
  EXPECT_GT(drive.counter("ticks_missed"), 0U);
  EXPECT_NE(drive.state().find("overloaded"), std::string::npos);
  for (const std::string& state : drive.states())
    EXPECT_EQ(state.find("no_detections"), std::string::npos) << "they do come";
}

// A message that arrives while a tick works is newer than its start.
TEST(Overload, NoAgeIsNegative) {
  SimulatedDrive drive(Config{}, 25);
  drive.fusion_ms = 70;
  drive.run_for(5000);
  const auto is_age = [](double age_s) { return age_s >= 0.0 || age_s == -1.0; };
  for (const ServiceStatus& status : drive.statuses()) {
    EXPECT_PRED1(is_age, status.detections_age_s);
    EXPECT_PRED1(is_age, status.poses_age_s);
    EXPECT_GE(status.uptime_s, 0.0);
  }
  for (const PublishedMap& map : drive.maps()) EXPECT_PRED1(is_age, map.age_s);
}

}  // namespace
}  // namespace laneloom::service
