#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <deque>
#include <map>
#include <memory>

#include "faults.hpp"

// What the planner sees of each fault, and which counter tells; README, "When things go wrong".
namespace laneloom {
namespace {

constexpr std::int64_t kHour_ns = 3'600'000'000'000;

/// Everything arrives so many messages later.
template <class T>
Channel<T> delay(std::size_t messages) {
  return [messages, waiting = std::deque<T>()](T message) mutable {
    waiting.push_back(std::move(message));
    if (waiting.size() <= messages) return std::vector<T>{};
    std::vector<T> sent{waiting.front()};
    waiting.pop_front();
    return sent;
  };
}

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
  road_->send_frames(lose<DetectionFrame>);
  EXPECT_TRUE(says(MapState::degraded, StateReason::no_detections));
  EXPECT_TRUE(says(MapState::stale, StateReason::no_detections));
  EXPECT_TRUE(recovers());
}

TEST_F(Faults, PosesStop) {
  start();
  road_->send_poses(lose<VehiclePose>);
  EXPECT_TRUE(says(MapState::stale, StateReason::no_poses));
  EXPECT_TRUE(counts("detections_refused_unsynchronised"));
  EXPECT_TRUE(recovers());
}

TEST_F(Faults, PosesThatAreALittleLateAreWaitedFor) {
  start();
  const auto before = counters()["detections_refused_unsynchronised"];
  for (const std::size_t late : {5U, 15U}) {
    road_->send_poses(delay<VehiclePose>(late));
    EXPECT_TRUE(stays_good(20)) << late * 10 << " ms";
    road_->send_poses({});
  }
  EXPECT_EQ(counters()["detections_refused_unsynchronised"], before);
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
  road_->send_poses(delay<VehiclePose>(100));
  EXPECT_TRUE(says(MapState::stale, StateReason::unsynchronised));
  EXPECT_TRUE(counts("detections_refused_unsynchronised"));
  EXPECT_TRUE(recovers());
}

TEST_F(Faults, MessagesOutOfOrderAreRefused) {
  start();
  road_->send_frames(swap_pairs<DetectionFrame>());
  road_->send_poses(swap_pairs<VehiclePose>());
  EXPECT_TRUE(counts("detections_refused_late"));
  EXPECT_TRUE(counts("poses_refused_late"));
  EXPECT_TRUE(stays_good(10));
  EXPECT_EQ(counters()["map_resets"], 0U);
}

TEST_F(Faults, RepeatedMessagesAreRefused) {
  start();
  road_->send_frames([](const DetectionFrame& frame) { return std::vector{frame, frame}; });
  road_->send_poses([](const VehiclePose& pose) { return std::vector{pose, pose}; });
  EXPECT_TRUE(stays_good(10));
  EXPECT_TRUE(counts("detections_refused_repeated"));
  EXPECT_TRUE(counts("poses_refused_repeated"));
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
  EXPECT_TRUE(maps_.wait_for([](const PublishedMap& map) { return map.fused_frames.size() >= 10; }));
  EXPECT_TRUE(recovers());
  EXPECT_EQ(counters()["detections_refused_late"], 0U);
}

TEST_F(Faults, StampsThatJumpResetTheMap) {
  for (const std::int64_t jump_ns : {kHour_ns, -kHour_ns}) {
    service_.reset();
    road_.reset();
    start();
    const auto jump = [jump_ns](auto message) {
      message.stamp_ns += jump_ns;
      return std::vector{message};
    };
    road_->send_frames(jump);
    road_->send_poses(jump);
    EXPECT_TRUE(maps_.wait_for([](const PublishedMap& map) { return has_reason(map, StateReason::reset); }));
    EXPECT_TRUE(maps_.wait_for(is_good));
    EXPECT_TRUE(counts("map_resets"));
    EXPECT_TRUE(counts("poses_refused_outlier"));
  }
}

TEST_F(Faults, APoseThatJumpsAndStaysResetsTheMap) {
  start();
  road_->send_poses([](VehiclePose pose) {
    pose.position.x() += 100.0;
    return std::vector{pose};
  });
  EXPECT_TRUE(maps_.wait_for([](const PublishedMap& map) { return has_reason(map, StateReason::reset); }));
  EXPECT_TRUE(maps_.wait_for(is_good));
  EXPECT_EQ(counters()["poses_refused_outlier"], 2U);
}

TEST_F(Faults, SinglePosesThatJumpAreRefused) {
  start();
  road_->send_poses([](VehiclePose pose) {
    if (pose.sequence % 7 == 0) pose.position.x() += 100.0;
    return std::vector{pose};
  });
  EXPECT_TRUE(counts("poses_refused_outlier"));
  EXPECT_TRUE(stays_good(10));
  EXPECT_EQ(counters()["map_resets"], 0U);
}

TEST_F(Faults, ARestartedPerceptionBeginsANewMap) {
  start();
  road_.reset();
  EXPECT_TRUE(says(MapState::stale, StateReason::no_detections));
  road_ = std::make_unique<StraightRoad>(config_);
  road_->send_frames([](DetectionFrame frame) {
    frame.session_id = 7;
    return std::vector{frame};
  });
  EXPECT_TRUE(maps_.wait_for([](const PublishedMap& map) { return has_reason(map, StateReason::reset); }));
  EXPECT_TRUE(maps_.wait_for(is_good));
}

TEST_F(Faults, AStoppedPlannerHoldsUpNobody) {
  start();
  const Process planner({LANELOOM, "pnc", "--domain", std::to_string(config_.domain), "--vehicle-id",
                         config_.vehicle_id, "--record", "/dev/null"});
  Listener<PublishedMap> other(config_);
  ASSERT_TRUE(other.wait_for(is_good));
  planner.signal(SIGSTOP);
  ASSERT_TRUE(stays_good(50));
  const auto samples = maps_.samples();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].sequence, samples[0].sequence + i) << "a map was held up or lost";
  }
  EXPECT_EQ(counters()["writes_failed"], 0U);
}

// Fast DDS matches two participants no more when only one of them saw the other's lease end.
TEST_F(Faults, APerceptionThatHangsIsHeardAgain) {
  service_ = std::make_unique<Process>(command(config_));
  const Process perception({LANELOOM, "publish", "--scenario", "straight", "--loop", "--domain",
                            std::to_string(config_.domain), "--vehicle-id", config_.vehicle_id});
  ASSERT_TRUE(maps_.wait_for(is_good)) << service_->errors();
  for (int hang_ms = 1200; hang_ms <= 1700; hang_ms += 50) {
    perception.signal(SIGSTOP);
    usleep(static_cast<unsigned>(hang_ms) * 1000);
    perception.signal(SIGCONT);
    maps_.forget();
    ASSERT_TRUE(maps_.wait_for(is_good)) << "not heard after " << hang_ms << " ms";
  }
}

TEST_F(Faults, AServiceThatHangsIsNoticed) {
  start();
  service_->signal(SIGSTOP);
  EXPECT_TRUE(maps_.wait_for_alive(0));
  service_->signal(SIGCONT);
  EXPECT_TRUE(maps_.wait_for_alive(1));
  EXPECT_TRUE(counts("ticks_missed"));
  EXPECT_TRUE(recovers());
}

TEST_F(Faults, TheSystemClockMayJump) {
#ifndef LIBFAKETIME
  GTEST_SKIP() << "libfaketime is missing, or does not go with a sanitizer";
#else
  const TemporaryFile clock("clock", "+0\n");
  std::vector<std::string> words{"/usr/bin/env", "LD_PRELOAD=" LIBFAKETIME,
                                 "FAKETIME_TIMESTAMP_FILE=" + clock.path, "FAKETIME_NO_CACHE=1",
                                 "DONT_FAKE_MONOTONIC=1"};
  for (const auto& word : command(config_)) words.push_back(word);
  service_ = std::make_unique<Process>(words);
  road_ = std::make_unique<StraightRoad>(config_);
  ASSERT_TRUE(maps_.wait_for(is_good)) << service_->errors();
  const auto before_ns = maps_.samples().back().published_ns;
  for (const std::string jump : {"+3600\n", "-3600\n"}) {
    clock.write(jump);
    ASSERT_TRUE(maps_.wait_for([&](const PublishedMap& map) {
      return std::abs(map.published_ns - before_ns) > kHour_ns / 2;
    })) << "the clock did not jump";
    EXPECT_TRUE(stays_good(20));
  }
#endif
}

TEST_F(Faults, TwoServicesOfOneVehicleSaySo) {
  start();
  auto second = std::make_unique<Process>(command(config_));
  std::map<std::uint64_t, bool> warned;
  EXPECT_TRUE(maps_.wait_for([&](const PublishedMap& map) {
    if (has_reason(map, StateReason::another_service)) warned[map.session_id] = true;
    return warned.size() == 2;
  }));
  second.reset();
  EXPECT_TRUE(recovers());
}

TEST_F(Faults, KilledWithSharedMemoryItStartsAgain) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "Fast DDS synchronises its shared memory by what the sanitizer does not see";
#endif
  const TemporaryFile file("shm.yaml", "dds:\n  transport: udp+shm\n");
  auto with_memory = config_;
  with_memory.transport = "udp+shm";
  Listener<PublishedMap> maps(with_memory);
  const StraightRoad road(with_memory);
  for (int i = 0; i < 4; ++i) {
    Process service(command(config_, {"--config", file.path}));
    maps.forget();
    ASSERT_TRUE(maps.wait_for(is_good)) << service.errors();
    service.signal(SIGKILL);
    ASSERT_EQ(service.wait(), -SIGKILL);
  }
}

}  // namespace
}  // namespace laneloom
