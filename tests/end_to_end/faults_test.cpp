#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "faults.hpp"

// What the planner sees of wrong, late and missing messages, and which counter tells; deploy/README.md,
// "When things go wrong".
namespace laneloom {
namespace {

constexpr std::int64_t kHour_ns = 3'600'000'000'000;

/// Of each pair the second arrives first.
template <class T>
Channel<T> swap_pairs() {
  return [held = std::vector<T>()](T message) mutable {
    held.push_back(std::move(message));
    if (held.size() < 2) return std::vector<T>{};
    std::swap(held[0], held[1]);
    return std::exchange(held, {});
  };
}

TEST_F(Faults, DetectionsStop) {
  start();
  bool warned = false;
  // It warns for a tick or two, which a busy host may leave out.
  for (int attempt = 0; attempt < 5 && !warned; ++attempt) {
    maps_.forget();
    road_->send_frames(lose<DetectionFrame>);
    ASSERT_TRUE(says(MapState::stale, StateReason::no_detections));
    warned = std::ranges::any_of(maps_.samples(), saying(MapState::degraded, StateReason::no_detections));
    ASSERT_TRUE(recovers());
  }
  EXPECT_TRUE(warned);
}

TEST_F(Faults, PosesStop) {
  start();
  const auto before = counters();
  road_->send_poses(lose<VehiclePose>);
  EXPECT_TRUE(says(MapState::stale, StateReason::no_poses));
  EXPECT_TRUE(rises("detections_refused_unsynchronised", before));
  EXPECT_TRUE(recovers());
}

TEST_F(Faults, PosesThatAreALittleLateAreWaitedFor) {
  start();
  for (const std::size_t late : {5U, 15U}) {
    road_->send_poses(delay<VehiclePose>(late));
    // No map is good for a second after a frame was refused.
    ASSERT_TRUE(is_good_again(20)) << late * 10 << " ms";
    road_->send_poses({});
  }
}

TEST_F(Faults, PosesThatAreHalfASecondLateMakeTheMapOld) {
  start();
  road_->send_poses(delay<VehiclePose>(50));
  const auto is_old = [](const PublishedMap& map) {
    return map.state == MapState::stale && map.age_s > 0.4 && !map.fused_frames.empty() && has_lanes(map);
  };
  EXPECT_TRUE(maps_.wait_for(is_old));
  EXPECT_TRUE(recovers());
}

TEST_F(Faults, PosesThatAreLaterStillMatchNothing) {
  start();
  const auto before = counters();
  road_->send_poses(delay<VehiclePose>(100));
  EXPECT_TRUE(says(MapState::stale, StateReason::unsynchronised));
  EXPECT_TRUE(rises("detections_refused_unsynchronised", before));
  EXPECT_TRUE(recovers());
}

TEST_F(Faults, FramesOutOfOrderAreFusedAndPosesOutOfOrderRefused) {
  start();
  const auto before = counters();
  road_->send_frames(swap_pairs<DetectionFrame>());
  road_->send_poses(swap_pairs<VehiclePose>());
  EXPECT_TRUE(rises("frames_fused", before));
  EXPECT_TRUE(rises("poses_refused_late", before));
  EXPECT_TRUE(stays_good(10));
  EXPECT_EQ(counters()["map_resets"], 0U);
}

TEST_F(Faults, RepeatedMessagesAreRefused) {
  start();
  const auto before = counters();
  road_->send_frames([](const DetectionFrame& frame) { return std::vector{frame, frame}; });
  road_->send_poses([](const VehiclePose& pose) { return std::vector{pose, pose}; });
  EXPECT_TRUE(stays_good(10));
  EXPECT_TRUE(rises("detections_refused_repeated", before));
  EXPECT_TRUE(rises("poses_refused_repeated", before));
  EXPECT_EQ(counters()["map_resets"], 0U);
}

TEST_F(Faults, DetectionsAtHalfTheRateAreEnough) {
  start(200);
  EXPECT_TRUE(stays_good(20));
}

TEST_F(Faults, DetectionsAtFourTimesTheRateAreAllFused) {
  start(25);
  EXPECT_TRUE(stays_good(20));
  EXPECT_EQ(counters()["frames_dropped_queue_full"], 0U);
}

TEST_F(Faults, ABurstOfDetectionsIsFusedWhole) {
  start();
  road_->send_frames([held = std::vector<DetectionFrame>()](DetectionFrame frame) mutable {
    held.push_back(std::move(frame));
    return held.size() < 10 ? std::vector<DetectionFrame>{} : std::exchange(held, {});
  });
  EXPECT_TRUE(says(MapState::stale, StateReason::no_detections)) << "between the bursts";
  // A tick may come amid a burst.
  const auto whole = [before = std::size_t{0}](const PublishedMap& map) mutable {
    return std::exchange(before, map.fused_frames.size()) + map.fused_frames.size() >= 10;
  };
  EXPECT_TRUE(maps_.wait_for(whole));
  EXPECT_TRUE(recovers());
}

TEST_F(Faults, StampsThatJumpResetTheMap) {
  for (const std::int64_t jump_ns : {kHour_ns, -kHour_ns}) {
    service_.reset();
    road_.reset();
    start();
    const auto before = counters();
    const auto jump = [jump_ns](auto message) {
      message.stamp_ns += jump_ns;
      return std::vector{message};
    };
    road_->send_frames(jump);
    road_->send_poses(jump);
    EXPECT_TRUE(maps_.wait_for([](const PublishedMap& map) { return has_reason(map, StateReason::reset); }));
    EXPECT_TRUE(is_good_again());
    EXPECT_TRUE(rises("map_resets", before));
    EXPECT_TRUE(rises("poses_refused_outlier", before));
  }
}

TEST_F(Faults, APoseThatJumpsAndStaysResetsTheMap) {
  start();
  road_->send_poses([](VehiclePose pose) {
    pose.position.x() += 100.0;
    return std::vector{pose};
  });
  EXPECT_TRUE(maps_.wait_for([](const PublishedMap& map) { return has_reason(map, StateReason::reset); }));
  EXPECT_TRUE(is_good_again());
  EXPECT_EQ(counters()["poses_refused_outlier"], 2U);
}

TEST_F(Faults, SinglePosesThatJumpAreRefused) {
  start();
  const auto before = counters();
  road_->send_poses([](VehiclePose pose) {
    if (pose.sequence % 7 == 0) pose.position.x() += 100.0;
    return std::vector{pose};
  });
  EXPECT_TRUE(rises("poses_refused_outlier", before));
  EXPECT_TRUE(stays_good(10));
  EXPECT_EQ(counters()["map_resets"], 0U);
}

}  // namespace
}  // namespace laneloom
