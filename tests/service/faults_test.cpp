#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "simulated_drive.hpp"

// The planner gets a map in spite of wrong, late and missing messages, and a counter tells of them;
// deploy/README.md, "When things go wrong".
namespace laneloom::service {
namespace {

using States = std::vector<std::string>;

constexpr std::int64_t kHour_ms = 3'600'000;

/// The second message of each pair arrives first.
template <class T>
Channel<T> swap_pairs() {
  return [pairs = bunch<T>(2)](T message) {
    std::vector<T> sent = pairs(std::move(message));
    std::ranges::reverse(sent);
    return sent;
  };
}

template <class T>
Channel<T> jump(std::int64_t jump_ms) {
  return [jump_ms](T message) {
    message.stamp_ns += jump_ms * 1'000'000;
    return std::vector{message};
  };
}

bool has_lanes(const PublishedMap& map) { return !map.map.lanes.empty(); }

class Faults : public ::testing::Test {
 protected:
  void SetUp() override {
    drive_.run_for(1000);
    ASSERT_EQ(drive_.state(), "OK");
  }
  /// The fault ends; what was missing is told for at most a second.
  void recover() {
    drive_.send_frames = {};
    drive_.send_poses = {};
    drive_.run_for(2000);
    EXPECT_EQ(drive_.state(), "OK");
  }
  bool all_have_lanes() const { return std::ranges::all_of(drive_.maps(), has_lanes); }

  SimulatedDrive drive_;
};

TEST_F(Faults, DetectionsStop) {
  drive_.send_frames = lose<DetectionFrame>;
  drive_.run_for(700);
  EXPECT_EQ(drive_.states(),
            (States{"OK", "DEGRADED no_detections", "STALE no_detections", "STALE no_detections outdated"}));
  EXPECT_TRUE(all_have_lanes());
  EXPECT_EQ(drive_.maps()[2].state, MapState::ok) << "0.2 s";
  EXPECT_EQ(drive_.maps()[3].state, MapState::degraded) << "0.3 s";
  EXPECT_EQ(drive_.maps()[5].state, MapState::stale) << "0.5 s";
  recover();
}

TEST_F(Faults, PosesStop) {
  drive_.send_poses = lose<VehiclePose>;
  drive_.run_for(1200);
  EXPECT_EQ(drive_.states(),
            (States{"OK", "DEGRADED no_poses", "STALE no_poses", "STALE no_poses unsynchronised"}));
  EXPECT_TRUE(all_have_lanes());
  EXPECT_GT(drive_.counter("detections_refused_unsynchronised"), 0U);
  recover();
}

/// Messages that the threads of DDS refuse are not missing.
TEST_F(Faults, RefusedMessagesAreNotMissing) {
  const auto refuse = [this](int tenths, auto&& one) {
    for (int i = 0; i < tenths; ++i) {
      one(drive_.now_ns());
      drive_.run_for(100);
    }
  };
  drive_.send_frames = lose<DetectionFrame>;
  refuse(20,
         [this](std::int64_t now_ns) { drive_.queue().refuse(Input::detections, "wrong_frame", now_ns); });
  EXPECT_EQ(drive_.state(), "STALE unsynchronised outdated");
  recover();
  drive_.send_poses = lose<VehiclePose>;
  refuse(20, [this](std::int64_t now_ns) { drive_.queue().refuse(Input::poses, "wrong_frame", now_ns); });
  EXPECT_EQ(drive_.state(), "STALE unsynchronised");
  recover();
}

TEST_F(Faults, NothingComesAtAll) {
  drive_.send_frames = lose<DetectionFrame>;
  drive_.send_poses = lose<VehiclePose>;
  drive_.run_for(3000);
  EXPECT_EQ(drive_.state(), "STALE no_detections no_poses");
  EXPECT_EQ(drive_.maps().size(), 30U) << "a map at every tick";
  EXPECT_TRUE(all_have_lanes());
}

TEST_F(Faults, PosesThatAreALittleLateAreWaitedFor) {
  for (const std::size_t late : {5U, 15U}) {
    drive_.send_poses = delay<VehiclePose>(late);
    drive_.run_for(2000);
    EXPECT_EQ(drive_.states(), States{"OK"}) << late * 10 << " ms";
  }
  EXPECT_EQ(drive_.counter("detections_refused_unsynchronised"), 0U);
}

TEST_F(Faults, PosesThatAreHalfASecondLateMakeTheMapOld) {
  drive_.send_poses = delay<VehiclePose>(50);
  drive_.run_for(2000);
  const PublishedMap& map = drive_.maps().back();
  EXPECT_EQ(map.state, MapState::stale);
  EXPECT_GT(map.age_s, 0.4);
  EXPECT_FALSE(map.fused_frames.empty());
  EXPECT_TRUE(all_have_lanes());
  recover();
}

TEST_F(Faults, PosesThatAreLaterStillMatchNothing) {
  drive_.send_poses = delay<VehiclePose>(100);
  drive_.run_for(2500);
  EXPECT_EQ(drive_.state(), "STALE unsynchronised outdated");
  EXPECT_TRUE(drive_.maps().back().fused_frames.empty());
  EXPECT_GT(drive_.counter("detections_refused_unsynchronised"), 0U);
  recover();
}

TEST_F(Faults, OnePoseWhoseStampIsAheadLeavesTheMap) {
  const auto map_id = drive_.maps().back().map_id;
  for (const std::int64_t ahead_ms : {250, 500, 1900}) {
    drive_.send_poses = [ahead_ms, sent = 0](VehiclePose pose) mutable {
      if (++sent == 30) pose.stamp_ns += ahead_ms * 1'000'000;
      return std::vector{pose};
    };
    drive_.run_for(2000);
    EXPECT_EQ(drive_.state(), "OK") << ahead_ms;
    EXPECT_EQ(drive_.maps().back().map_id, map_id) << ahead_ms;
    EXPECT_TRUE(all_have_lanes()) << ahead_ms;
  }
  EXPECT_GT(drive_.counter("poses_refused_late"), 0U);
}

TEST_F(Faults, PosesOutOfOrderAreRefused) {
  drive_.send_poses = swap_pairs<VehiclePose>();
  drive_.run_for(2000);
  EXPECT_EQ(drive_.states(), States{"OK"});
  EXPECT_GT(drive_.counter("poses_refused_late"), 0U);
  EXPECT_EQ(drive_.counter("map_resets"), 0U);
}

TEST(FaultsAtFortyHertz, ShuffledFramesAreAllFusedOnce) {
  SimulatedDrive drive(Config{}, 25);
  drive.send_frames = [groups = bunch<DetectionFrame>(4)](DetectionFrame frame) {
    std::vector<DetectionFrame> sent = groups(std::move(frame));
    if (sent.size() == 4) sent = {sent[2], sent[0], sent[3], sent[1]};
    return sent;
  };
  drive.run_for(3000);
  EXPECT_EQ(drive.state(), "OK");
  std::set<std::uint64_t> sequences;
  for (const FusedFrame& frame : drive.fused()) EXPECT_TRUE(sequences.insert(frame.sequence).second);
  ASSERT_GT(sequences.size(), 100U);
  EXPECT_EQ(*sequences.rbegin() - *sequences.begin() + 1, sequences.size()) << "a frame is missing";
  EXPECT_EQ(drive.maps().back().map.lanes.size(), 1U);
}

TEST(FaultsAtFortyHertz, AllFramesAreFused) {
  SimulatedDrive drive(Config{}, 25);
  drive.run_for(2000);  // the first frame is older than the first pose
  drive.run_for(1000);
  EXPECT_EQ(drive.states(), States{"OK"});
  const auto frames = drive.fused();
  EXPECT_GE(frames.size(), 38U);
  for (std::size_t i = 1; i < frames.size(); ++i)
    EXPECT_EQ(frames[i].sequence, frames[i - 1].sequence + 1) << "every one";
}

TEST(Phase, MapsFollowTheFramesAndThePosesOfTheirStamps) {
  for (const std::size_t late_poses : {0U, 6U, 9U}) {  // 6: they come 20 ms after the frame of their stamp
    SimulatedDrive drive(Config{}, 105);
    if (late_poses > 0) drive.send_poses = delay<VehiclePose>(late_poses);
    drive.run_for(1000);
    drive.run_for(5000);
    for (std::size_t i = 3; i < drive.maps().size(); ++i) {
      const PublishedMap& map = drive.maps()[i];
      EXPECT_EQ(map.fused_frames.size(), 1U) << late_poses;
      EXPECT_LE(map.age_s, 0.001 + 0.01 * static_cast<double>(late_poses)) << "beside the wait for the pose";
    }
  }
}

TEST(FaultsAtFiveHertz, AreNone) {
  SimulatedDrive drive(Config{}, 200);
  drive.run_for(1000);
  drive.run_for(2000);
  EXPECT_EQ(drive.states(), States{"OK"});
}

TEST_F(Faults, RepeatedMessagesAreRefused) {
  drive_.send_frames = [](const DetectionFrame& frame) { return std::vector{frame, frame}; };
  drive_.send_poses = [](const VehiclePose& pose) { return std::vector{pose, pose}; };
  drive_.run_for(2000);
  EXPECT_EQ(drive_.states(), States{"OK"});
  EXPECT_GT(drive_.counter("detections_refused_repeated"), 0U);
  EXPECT_GT(drive_.counter("poses_refused_repeated"), 0U);
  EXPECT_EQ(drive_.counter("map_resets"), 0U);
}

TEST_F(Faults, ABurstOfDetectionsIsFusedWhole) {
  drive_.send_frames = bunch<DetectionFrame>(10);
  drive_.run_for(3000);
  EXPECT_EQ(drive_.fused().size(), 21U);
  EXPECT_TRUE(
      std::ranges::any_of(drive_.maps(), [](const auto& map) { return map.fused_frames.size() == 10; }));
  States states;
  for (int burst = 0; burst < 3; ++burst)
    states.insert(states.end(),
                  {"OK", "DEGRADED no_detections", "STALE no_detections", "STALE no_detections outdated"});
  EXPECT_EQ(drive_.states(), states);
  recover();
}

TEST_F(Faults, StampsThatJumpResetTheMapOnce) {
  for (const std::int64_t jump_ms : {kHour_ms, -kHour_ms}) {
    SimulatedDrive drive;
    drive.run_for(1000);
    const auto map_id = drive.maps().back().map_id;
    drive.send_frames = jump<DetectionFrame>(jump_ms);
    drive.send_poses = jump<VehiclePose>(jump_ms);
    drive.run_for(3000);
    EXPECT_EQ(drive.state(), "OK");
    EXPECT_NE(drive.maps().back().map_id, map_id);
    EXPECT_TRUE(std::ranges::any_of(drive.maps(), [](const PublishedMap& map) {
      return std::ranges::count(map.reasons, StateReason::reset) > 0;
    }));
    EXPECT_EQ(drive.counter("map_resets"), 1U);
    EXPECT_EQ(drive.counter("poses_refused_outlier"), 2U);
  }
}

TEST_F(Faults, PosesThatStopForSecondsKeepTheMap) {
  const auto map_id = drive_.maps().back().map_id;
  drive_.send_poses = lose<VehiclePose>;
  drive_.run_for(5000);
  EXPECT_EQ(drive_.state(), "STALE no_poses unsynchronised");
  drive_.send_poses = {};
  drive_.run_for(3000);
  EXPECT_EQ(drive_.state(), "OK");
  EXPECT_EQ(drive_.maps().back().map_id, map_id);
  EXPECT_EQ(drive_.counter("poses_refused_outlier"), 2U);
  EXPECT_EQ(drive_.counter("map_resets"), 0U);
}

TEST_F(Faults, APoseThatJumpsAndStaysResetsTheMap) {
  const auto map_id = drive_.maps().back().map_id;
  drive_.send_poses = [](VehiclePose pose) {
    pose.position.x() += 100.0;
    return std::vector{pose};
  };
  drive_.run_for(3000);
  EXPECT_EQ(drive_.state(), "OK");
  EXPECT_NE(drive_.maps().back().map_id, map_id);
  EXPECT_EQ(drive_.counter("poses_refused_outlier"), 2U);
  EXPECT_EQ(drive_.counter("map_resets"), 1U);
}

TEST_F(Faults, PosesThatJumpBelowTheGateMoveTheMap) {
  const auto map_id = drive_.maps().back().map_id;
  const auto lanes = drive_.maps().back().map.lanes;
  drive_.send_poses = [](VehiclePose pose) {
    pose.position.y() += 1.5;
    return std::vector{pose};
  };
  drive_.run_for(3000);
  EXPECT_EQ(drive_.states(), (States{"OK", "DEGRADED poses_jumped", "OK"}));
  EXPECT_EQ(drive_.maps().back().map_id, map_id);
  EXPECT_EQ(drive_.counter("pose_jumps"), 1U);
  ASSERT_EQ(drive_.maps().back().map.lanes.size(), 1U);
  const Lane& lane = drive_.maps().back().map.lanes.front();
  EXPECT_EQ(lane.id, lanes.front().id);
  for (const Point& point : lane.centerline) EXPECT_NEAR(point.y(), 1.5, 0.1);
}

TEST_F(Faults, SinglePosesThatJumpAreRefused) {
  drive_.send_poses = [](VehiclePose pose) {
    if (pose.sequence % 7 == 0) pose.position.x() += 100.0;
    return std::vector{pose};
  };
  drive_.run_for(2000);
  EXPECT_EQ(drive_.states(), States{"OK"});
  EXPECT_GT(drive_.counter("poses_refused_outlier"), 10U);
  EXPECT_EQ(drive_.counter("map_resets"), 0U);
}

TEST_F(Faults, ARestartedPerceptionKeepsTheMap) {
  const auto map_id = drive_.maps().back().map_id;
  drive_.send_frames = lose<DetectionFrame>;
  drive_.run_for(1000);
  EXPECT_EQ(drive_.state(), "STALE no_detections outdated");
  drive_.send_frames = [](DetectionFrame frame) { return std::vector{of_source(std::move(frame), "", 7)}; };
  drive_.run_for(2000);
  EXPECT_EQ(drive_.state(), "OK");
  EXPECT_EQ(drive_.maps().back().map_id, map_id);
  EXPECT_EQ(drive_.counter("sources_restarted"), 1U);
  EXPECT_EQ(drive_.counter("map_resets"), 0U);
}

TEST_F(Faults, ARestartedOdometryBeginsANewMap) {
  const auto map_id = drive_.maps().back().map_id;
  drive_.send_poses = [](VehiclePose pose) {
    pose.session_id = 9;
    return std::vector{pose};
  };
  drive_.run_for(2000);
  EXPECT_EQ(drive_.states(), (States{"OK", "DEGRADED reset", "OK"}));
  EXPECT_NE(drive_.maps().back().map_id, map_id);
  EXPECT_EQ(drive_.counter("map_resets"), 1U);
}

TEST_F(Faults, TheSystemClockMayJump) {
  for (const std::int64_t jump_ms : {kHour_ms, -kHour_ms}) {
    const auto before_ns = drive_.maps().back().published_ns;
    drive_.clock_jump_ms += jump_ms;
    drive_.run_for(2000);
    EXPECT_EQ(drive_.states(), States{"OK"});
    EXPECT_GT(std::abs(drive_.maps().front().published_ns - before_ns), kHour_ms * 900'000);
  }
}

TEST_F(Faults, AnotherServiceIsToldForAsLongAsItIsHeard) {
  drive_.queue().note_other_service(drive_.now_ns());
  drive_.run_for(4000);
  EXPECT_EQ(drive_.states(), (States{"DEGRADED another_service", "OK"}));
}

TEST_F(Faults, ADamagedFrameIsRefusedWhole) {
  drive_.send_frames = [](DetectionFrame frame) {
    if (frame.sequence % 2 == 1) frame.detections[0].points[0].x() = 1e300;
    return std::vector{frame};
  };
  drive_.run_for(2000);
  EXPECT_EQ(drive_.states(), States{"OK"});
  EXPECT_GE(drive_.counter("detections_refused_coordinate"), 4U);
  for (const FusedFrame& frame : drive_.fused()) EXPECT_EQ(frame.sequence % 2, 0U);
}

}  // namespace
}  // namespace laneloom::service
