#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>

#include "faults.hpp"

// Several cameras, frames that come late, and frames that are far too heavy; idl/README.md, "Detections".
namespace laneloom {
namespace {

/// What another perception stack makes of the same images.
DetectionFrame of_source(DetectionFrame frame, const std::string& source, std::uint64_t session) {
  frame.source = source;
  frame.session_id = session;
  return frame;
}

/// The fused frames of a source; 0 where it is not known.
std::uint64_t fused(const ServiceStatus& status, const std::string& source) {
  const auto found = std::ranges::find(status.sources, source, &SourceStatus::source);
  return found == status.sources.end() ? 0 : found->fused;
}

class Sources : public Faults {
 protected:
  /// Whether so many frames of each source are fused.
  bool all_fused(const std::vector<std::string>& sources, std::uint64_t frames = 20) {
    return status_.wait_for([&](const ServiceStatus& status) {
      return std::ranges::all_of(sources, [&](const auto& name) { return fused(status, name) >= frames; });
    });
  }
  /// Peak of the service's resident memory, in MB.
  double peak_memory_mb() const {
    std::ifstream file("/proc/" + std::to_string(service_->id()) + "/status");
    for (std::string line; std::getline(file, line);)
      if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024.0;
    return 0.0;
  }
};

TEST_F(Sources, OfDifferentLatenciesAreAllFused) {
  start();
  road_->send_frames([slow = delay<DetectionFrame>(2),
                      slowest = delay<DetectionFrame>(3)](const DetectionFrame& frame) mutable {
    std::vector sent{frame};
    for (auto& late : slow(of_source(frame, "side", 70))) sent.push_back(late);
    for (auto& late : slowest(of_source(frame, "rear", 80))) sent.push_back(late);
    return sent;
  });
  EXPECT_TRUE(all_fused({"side", "rear"}));
  EXPECT_TRUE(stays_good(10));
  EXPECT_EQ(counters()["map_resets"], 0U);
}

TEST_F(Sources, OneThatRestartsLeavesTheMapOfTheOthers) {
  start();
  const auto before = counters();
  road_->send_frames([](const DetectionFrame& frame) {
    return std::vector{frame, of_source(frame, "side", 70 + frame.sequence / 10)};
  });
  EXPECT_TRUE(rises("sources_restarted", before));
  EXPECT_TRUE(stays_good(20));
  EXPECT_EQ(counters()["map_resets"], 0U);
}

TEST_F(Sources, OneThatIsNotFusedIsTold) {
  start();
  road_->send_frames([broken = 0](const DetectionFrame& frame) mutable {
    auto other = of_source(frame, "side", 70);
    if (++broken > 10) other.stamp_ns -= 20'000'000'000;
    return std::vector{frame, other};
  });
  EXPECT_TRUE(says(MapState::degraded, StateReason::source_not_fused));
  EXPECT_TRUE(recovers());
}

TEST_F(Sources, ThatLagBehindThePosesMakeTheMapDegradedAndThenStale) {
  start();
  road_->send_frames(delay<DetectionFrame>(7));
  EXPECT_TRUE(says(MapState::degraded, StateReason::outdated));
  road_->send_frames(delay<DetectionFrame>(15));
  const auto is_old = [](const PublishedMap& map) {
    return saying(MapState::stale, StateReason::outdated)(map) && map.lag_s > 1.0 && map.age_s < 0.5;
  };
  EXPECT_TRUE(maps_.wait_for(is_old)) << "a backlog of 1.5 s";
  EXPECT_TRUE(recovers());
}

TEST_F(Sources, WithTheHeaviestFramesLeaveTheTicksTheirTime) {
  start(500);
  const auto before = counters();
  road_->send_frames([](DetectionFrame frame) {
    Detection heavy{.confidence = 0.4, .points = {}};
    for (int i = 0; i < 1024; ++i) heavy.points.emplace_back(-5.0 + 0.04 * i, 8.0 + i % 2 * 0.01, 0.0);
    frame.detections.resize(512, heavy);
    return std::vector{frame};
  });
  EXPECT_TRUE(rises("frames_thinned", before));
  EXPECT_TRUE(
      maps_.wait_for([](const PublishedMap& map) { return has_reason(map, StateReason::overloaded); }));
  const auto thinned = counters();
  EXPECT_TRUE(rises("frames_fused", thinned));
  EXPECT_LT(peak_memory_mb(), 96.0);
  EXPECT_EQ(counters()["map_resets"], 0U);
}

}  // namespace
}  // namespace laneloom
