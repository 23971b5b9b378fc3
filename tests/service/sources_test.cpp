#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "simulated_drive.hpp"

// Several perception stacks; idl/README.md, "Detections".
namespace laneloom::service {
namespace {

using States = std::vector<std::string>;

/// The fused frames of a source; 0 where it is not known.
std::uint64_t fused(const ServiceStatus& status, const std::string& source) {
  const auto found = std::ranges::find(status.sources, source, &SourceStatus::source);
  return found == status.sources.end() ? 0 : found->fused;
}

class SourcesOfADrive : public ::testing::Test {
 protected:
  void SetUp() override { drive_.run_for(1000); }
  std::uint64_t fused_of(const std::string& source) const { return fused(drive_.statuses().back(), source); }

  SimulatedDrive drive_;
};

TEST_F(SourcesOfADrive, OfDifferentLatenciesAreAllFused) {
  drive_.send_frames = [slow = delay<DetectionFrame>(2),
                        slowest = delay<DetectionFrame>(3)](const DetectionFrame& frame) mutable {
    std::vector sent{frame};
    for (auto& late : slow(of_source(frame, "side", 70))) sent.push_back(late);
    for (auto& late : slowest(of_source(frame, "rear", 80))) sent.push_back(late);
    return sent;
  };
  drive_.run_for(3000);
  EXPECT_EQ(drive_.states(), States{"OK"});
  EXPECT_GE(fused_of("side"), 15U);
  EXPECT_GE(fused_of("rear"), 15U);
  EXPECT_EQ(drive_.counter("map_resets"), 0U);
}

TEST_F(SourcesOfADrive, OneThatRestartsLeavesTheMapOfTheOthers) {
  drive_.send_frames = [](const DetectionFrame& frame) {
    return std::vector{frame, of_source(frame, "side", 70 + frame.sequence / 10)};
  };
  drive_.run_for(4000);
  EXPECT_EQ(drive_.states(), States{"OK"});
  EXPECT_GE(drive_.counter("sources_restarted"), 3U);
  EXPECT_EQ(drive_.counter("map_resets"), 0U);
}

TEST_F(SourcesOfADrive, OneThatIsNotFusedIsTold) {
  drive_.send_frames = [](const DetectionFrame& frame) {
    auto other = of_source(frame, "side", 70);
    if (frame.sequence > 20) other.stamp_ns -= 20'000'000'000;
    return std::vector{frame, other};
  };
  drive_.run_for(1000);
  EXPECT_EQ(drive_.states(), States{"OK"});
  drive_.run_for(3000);
  EXPECT_EQ(drive_.state(), "DEGRADED unsynchronised source_not_fused");
  drive_.send_frames = {};
  drive_.run_for(12'000);
  EXPECT_EQ(drive_.state(), "OK") << "it is missed for 10 s";
}

/// A second source, with confidences beyond 1.
std::vector<DetectionFrame> with_one_refused(const DetectionFrame& frame) {
  DetectionFrame other = of_source(frame, "side", 70);
  other.detections.at(0).confidence = 1.5;
  return {frame, other};
}

TEST_F(SourcesOfADrive, OneThatIsRefusedFromItsFirstFrameIsTold) {
  drive_.send_frames = with_one_refused;
  drive_.run_for(2000);
  EXPECT_EQ(drive_.state(), "DEGRADED source_not_fused");
  EXPECT_EQ(fused_of("side"), 0U);
}

TEST_F(SourcesOfADrive, OneThatIsRefusedIsToldAsLongAsItIsHeard) {
  drive_.send_frames = [](const DetectionFrame& frame) {
    return std::vector{frame, of_source(frame, "side", 70)};
  };
  drive_.run_for(1000);
  drive_.send_frames = with_one_refused;
  drive_.run_for(1000);
  drive_.run_for(15'000);
  EXPECT_EQ(drive_.states(), States{"DEGRADED source_not_fused"});
  drive_.send_frames = {};
  drive_.run_for(12'000);
  EXPECT_EQ(drive_.state(), "OK");
}

/// A second source sends each `nth` frame, too.
Channel<DetectionFrame> with_every(std::uint64_t nth) {
  return [nth](const DetectionFrame& frame) {
    std::vector sent{frame};
    if (frame.sequence % nth == 0) sent.push_back(of_source(frame, "side", 70));
    return sent;
  };
}

TEST_F(SourcesOfADrive, OneThatIsSlowIsNotMissedBetweenItsFrames) {
  for (const std::uint64_t nth : {5U, 10U, 20U}) {
    drive_.send_frames = with_every(nth);
    drive_.run_for(10'000);
    EXPECT_EQ(drive_.states(), States{"OK"}) << nth;
  }
  drive_.send_frames = {};
  drive_.run_for(4000);
  EXPECT_EQ(drive_.state(), "OK") << "the next frame of a source at 0.5 Hz may still come";
  drive_.run_for(3000);
  EXPECT_EQ(drive_.state(), "DEGRADED source_not_fused");
}

TEST_F(SourcesOfADrive, OneThatIsSlowAndNeverFusedIsTold) {
  drive_.send_frames = [slow = with_every(10)](const DetectionFrame& frame) {
    auto sent = slow(frame);
    for (std::size_t i = 1; i < sent.size(); ++i) sent[i].stamp_ns -= 20'000'000'000;
    return sent;
  };
  drive_.run_for(2000);
  drive_.run_for(5000);
  for (const std::string& state : drive_.states())
    EXPECT_NE(state.find("source_not_fused"), std::string::npos) << state;
}

TEST_F(SourcesOfADrive, OneThatDiesIsToldUntilItReturns) {
  const auto both = [](const DetectionFrame& frame) {
    return std::vector{frame, of_source(frame, "side", 70)};
  };
  drive_.send_frames = both;
  drive_.run_for(1000);
  drive_.send_frames = {};
  drive_.run_for(5000);
  EXPECT_EQ(drive_.states(), (States{"OK", "DEGRADED source_not_fused"}));
  drive_.send_frames = both;
  drive_.run_for(1000);
  EXPECT_EQ(drive_.states(), (States{"DEGRADED source_not_fused", "OK"}));
}

/// A second source sees everything further to the left.
Channel<DetectionFrame> with_one_beside(double left_m) {
  return [left_m](const DetectionFrame& frame) {
    DetectionFrame other = of_source(frame, "side", 70);
    for (Detection& detection : other.detections)
      for (Point& point : detection.points) point.y() += left_m;
    return std::vector{frame, other};
  };
}

TEST_F(SourcesOfADrive, OneThatContradictsIsToldAndLeftOut) {
  for (const double left_m : {1.75, -1.0}) {
    drive_.send_frames = with_one_beside(left_m);
    drive_.run_for(3000);
    EXPECT_EQ(drive_.state(), "DEGRADED sources_disagree source_not_fused");
    for (const PublishedMap& map : drive_.maps()) {
      ASSERT_EQ(map.map.lanes.size(), 1U);
      EXPECT_EQ(map.map.markings.size(), 2U);
    }
    const auto& sources = drive_.statuses().back().sources;
    const auto side = std::ranges::find(sources, "side", &SourceStatus::source);
    ASSERT_NE(side, sources.end());
    ASSERT_FALSE(side->learned.empty());
    EXPECT_EQ(side->learned.back().first, "beside_");
    EXPECT_NEAR(std::abs(side->learned.back().second), std::abs(left_m), 0.2);
    EXPECT_GT(drive_.counter("detections_refused_contradictory"), 15U);
    drive_.send_frames = with_one_beside(0.1);
    drive_.run_for(2000);
    EXPECT_EQ(drive_.state(), "OK") << "it agrees";
  }
}

TEST_F(SourcesOfADrive, OneThatContradictsFromItsFirstFrameIsNeverFused) {
  drive_.send_frames = with_one_beside(1.75);
  drive_.run_for(3000);
  EXPECT_EQ(fused_of("side"), 0U) << "the other one has no name";
}

TEST_F(SourcesOfADrive, OneThatContradictedIsFusedWhenItIsAlone) {
  drive_.send_frames = with_one_beside(1.75);
  drive_.run_for(1000);
  drive_.send_frames = [both = with_one_beside(1.75)](const DetectionFrame& frame) {
    return std::vector{both(frame).back()};
  };
  drive_.run_for(15'000);
  EXPECT_EQ(drive_.state(), "OK");
  EXPECT_GT(fused_of("side"), 30U);
}

TEST_F(SourcesOfADrive, OneThatContradictsStaysLeftOutWhileTheOtherOnePauses) {
  drive_.send_frames = with_one_beside(1.75);
  drive_.run_for(3000);
  drive_.send_frames = [both = with_one_beside(1.75)](const DetectionFrame& frame) {
    return std::vector{both(frame).back()};
  };
  drive_.run_for(5000);
  EXPECT_EQ(fused_of("side"), 0U);
  drive_.send_frames = with_one_beside(1.75);
  drive_.run_for(3000);
  EXPECT_EQ(drive_.state(), "DEGRADED sources_disagree source_not_fused");
  EXPECT_EQ(fused_of("side"), 0U);
}

TEST_F(SourcesOfADrive, OneThatContradictsStaysLeftOutWhenThePosesJump) {
  drive_.send_frames = with_one_beside(1.75);
  drive_.run_for(3000);
  drive_.send_poses = [](VehiclePose pose) {
    pose.position.y() += 0.9;
    return std::vector{pose};
  };
  drive_.run_for(3000);
  EXPECT_EQ(drive_.counter("pose_jumps"), 1U);
  EXPECT_EQ(drive_.state(), "DEGRADED sources_disagree source_not_fused");
  EXPECT_EQ(fused_of("side"), 0U);
}

TEST_F(SourcesOfADrive, OneThatContradictsIsLeftOutHoweverLateItIs) {
  drive_.send_frames = [late = delay<DetectionFrame>(12),
                        both = with_one_beside(1.75)](const DetectionFrame& frame) mutable {
    std::vector sent{frame};
    for (DetectionFrame& side : late(both(frame).back())) sent.push_back(std::move(side));
    return sent;
  };
  drive_.run_for(5000);
  EXPECT_EQ(drive_.state(), "DEGRADED sources_disagree source_not_fused");
  EXPECT_EQ(fused_of("side"), 0U);
}

TEST_F(SourcesOfADrive, ThatSeeOtherLinesDoNotContradict) {
  drive_.send_frames = [](const DetectionFrame& frame) {
    std::vector sent{frame, of_source(frame, "right", 70)};
    for (std::size_t i = 0; i < sent.size(); ++i) sent[i].detections = {frame.detections[1 - i]};
    return sent;
  };
  drive_.run_for(3000);
  EXPECT_EQ(drive_.states(), States{"OK"});
}

TEST_F(SourcesOfADrive, ThatLagBehindThePosesMakeTheMapDegradedAndThenStale) {
  drive_.send_frames = delay<DetectionFrame>(7);
  drive_.run_for(2000);
  EXPECT_EQ(drive_.state(), "DEGRADED outdated");
  drive_.send_frames = delay<DetectionFrame>(15);
  drive_.run_for(3000);
  EXPECT_EQ(drive_.state(), "STALE outdated") << "a backlog of 1.5 s";
  EXPECT_GT(drive_.maps().back().lag_s, 1.0);
  EXPECT_LT(drive_.maps().back().age_s, 0.5);
  drive_.send_frames = {};
  drive_.run_for(1000);
  EXPECT_EQ(drive_.state(), "OK");
}

TEST_F(SourcesOfADrive, ANinthIsToldSteadilyAndLeavesTheOthers) {
  drive_.send_frames = [](const DetectionFrame& frame) {
    std::vector<DetectionFrame> sent;
    for (int i = 1; i <= 9; ++i) sent.push_back(of_source(frame, "camera " + std::to_string(i), 70));
    return sent;
  };
  drive_.run_for(4000);  // until the only source before these is missed no more
  drive_.run_for(10'000);
  EXPECT_EQ(drive_.states(), States{"DEGRADED source_not_fused"});
  for (int i = 1; i <= 7; ++i) EXPECT_GT(fused_of("camera " + std::to_string(i)), 100U) << i;
  EXPECT_GT(drive_.counter("detections_refused_too_many_sources"), 100U);
  drive_.send_frames = {};
  drive_.run_for(14'000);
  EXPECT_EQ(drive_.state(), "OK");
}

}  // namespace
}  // namespace laneloom::service
