#include "session/mapping_session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "mapping/state.hpp"
#include "milliseconds.hpp"

namespace laneloom::session {
namespace {

VehiclePose pose(std::int64_t stamp_ms, std::uint64_t session = 1) {
  return {.stamp_ns = stamp_ms * kMs,
          .session_id = session,
          .position = {0.01 * static_cast<double>(stamp_ms % 1'000'000), 0.0, 0.0}};
}

/// Two lines along the road.
DetectionFrame frame(std::int64_t stamp_ms, std::uint64_t session = 1) {
  DetectionFrame result{
      .stamp_ns = stamp_ms * kMs, .sequence = static_cast<std::uint64_t>(stamp_ms), .session_id = session};
  for (const double y : {-1.75, 1.75}) {
    result.detections.push_back(Detection{.confidence = 0.9, .points = {{0.0, y, 0.0}, {25.0, y, 0.0}}});
  }
  return result;
}

/// A car that drives ahead of the vehicle in its lane.
TrackedObjects objects(std::int64_t stamp_ms, std::uint64_t session = 1) {
  return {.stamp_ns = stamp_ms * kMs,
          .session_id = session,
          .objects = {{.id = 7,
                       .kind = ObjectKind::car,
                       .position = {15.0, 0.0, 0.0},
                       .heading = {1.0, 0.0, 0.0},
                       .speed_mps = 10.0}}};
}

class MappingSessionTest : public ::testing::Test {
 protected:
  /// Poses every 10 ms and frames every 100 ms, each frame 50 ms after its stamp.
  void drive(std::int64_t from_ms, std::int64_t to_ms, std::uint64_t session = 1) {
    for (std::int64_t t = from_ms; t < to_ms; t += 10) {
      session_.add(pose(t, session));
      if (t % 100 == 50 && t - 50 >= from_ms) add(frame(t - 50, session));
    }
  }
  void add(const DetectionFrame& frame) {
    session_.add(frame, 0);
    ++added_;
  }
  std::vector<std::int64_t> fused_ms() {
    std::vector<std::int64_t> stamps;
    for (const auto& fused : session_.take_progress().fused) stamps.push_back(fused.stamp_ns / kMs);
    return stamps;
  }
  std::uint64_t refused() const {
    std::uint64_t sum = 0;
    for (const auto& [name, count] : session_.counters().values()) {
      if (name.starts_with("detections_refused_")) sum += count;
    }
    return sum;
  }
  void TearDown() override {
    EXPECT_EQ(session_.counters()["frames_fused"] + refused() +
                  session_.counters()["frames_dropped_queue_full"] + session_.pending(),
              added_);
  }
  using Stamps = std::vector<std::int64_t>;

  MappingSession session_{Config{}};
  std::uint64_t added_ = 0;
};

TEST_F(MappingSessionTest, MakesAMapAndSaysOfWhat) {
  drive(10'000, 12'000);
  EXPECT_EQ(session_.map().stamp_ns, 11'900 * kMs);
  EXPECT_EQ(session_.map().lanes.size(), 1U);
  const auto progress = session_.take_progress();
  EXPECT_EQ(progress.fused.size(), 20U);
  EXPECT_EQ(progress.fused[3].sequence, 10'300U);
  EXPECT_FALSE(progress.lineage.empty());
  EXPECT_TRUE(session_.take_progress().fused.empty());
}

TEST_F(MappingSessionTest, FramesThatWaitedAreFusedInTheOrderOfTheirStamps) {
  session_.add(pose(10'000));
  for (const int stamp : {10'030, 10'010, 10'020}) {
    add(frame(stamp));
  }
  EXPECT_EQ(fused_ms(), Stamps{});
  session_.add(pose(10'100));
  EXPECT_EQ(fused_ms(), (Stamps{10'010, 10'020, 10'030}));
}

TEST_F(MappingSessionTest, AFrameOlderThanTheNewestFusedIsFusedWithItsOwnPose) {
  drive(10'000, 10'300);
  fused_ms();
  add(frame(10'150));
  auto other = frame(10'150);
  other.source = "another";
  add(other);
  EXPECT_EQ(fused_ms(), (Stamps{10'150, 10'150}));
  EXPECT_EQ(session_.map().stamp_ns, 10'200 * kMs) << "the map is of the newest frame";
  EXPECT_NEAR(session_.map().T_map_body.translation().x(), 0.01 * 10'200, 1e-9);
  add(frame(10'150));
  EXPECT_EQ(session_.counters()["detections_refused_repeated"], 1U);
}

// A far camera delivers 30 ms after its stamp, a near one 200 ms: each of its frames is older than one that
// was fused before.
TEST_F(MappingSessionTest, TwoSourcesOfDifferentLatencyAreBothFused) {
  for (std::int64_t t = 10'000; t < 12'000; t += 10) {
    session_.add(pose(t));
    if (t % 100 == 30) {
      auto fast = frame(t - 30);
      fast.source = "fast";
      add(fast);
    }
    if (t % 100 == 50 && t >= 10'300) {
      auto slow = frame(t - 200);
      slow.source = "slow";
      add(slow);
    }
  }
  const auto sources = session_.sources();
  ASSERT_EQ(sources.size(), 2U);
  EXPECT_EQ(sources[0].source, "fast");
  EXPECT_EQ(sources[0].fused, 20U);
  EXPECT_EQ(sources[1].fused, 17U);
  EXPECT_EQ(refused(), 0U);
  EXPECT_EQ(session_.map().lanes.size(), 1U);
  EXPECT_NEAR(*session_.lag_s(), 0.09, 1e-9);
}

TEST_F(MappingSessionTest, ASourceThatIsRestartedLeavesTheMapAndTheOthers) {
  drive(10'000, 12'000);
  const auto id = session_.map().boundaries.at(0).id;
  auto restarted = frame(12'000, 77);
  add(restarted);
  session_.add(pose(12'050));
  EXPECT_EQ(fused_ms().back(), 12'000);
  EXPECT_EQ(session_.counters()["map_resets"], 0U);
  EXPECT_EQ(session_.counters()["sources_restarted"], 1U);
  EXPECT_EQ(session_.map().boundaries.at(0).id, id);
}

TEST_F(MappingSessionTest, FramesForWhichNoTimeIsLeftWait) {
  for (std::int64_t t = 10'000; t <= 10'500; t += 10) session_.add(pose(t));
  session_.fuse_while([this] { return session_.counters()["frames_fused"] < 3; });
  for (const int stamp : {10'100, 10'200, 10'300, 10'400, 10'450}) add(frame(stamp));
  EXPECT_EQ(fused_ms(), (Stamps{10'100, 10'200, 10'300}));
  session_.expire(60'000 * kMs);
  EXPECT_EQ(session_.pending(), 2U);
  EXPECT_EQ(session_.ready(), 2U);
  session_.fuse_while([] { return false; });
  EXPECT_EQ(fused_ms(), Stamps{10'400}) << "one at least";
  session_.fuse_while({});
  EXPECT_EQ(fused_ms(), Stamps{10'450});
  EXPECT_EQ(session_.ready(), 0U);
}

TEST_F(MappingSessionTest, ALongFrameIsThinnedAndCounted) {
  drive(10'000, 10'300);
  auto heavy = frame(10'250);
  heavy.detections.resize(300, heavy.detections[0]);
  add(heavy);
  EXPECT_EQ(session_.counters()["frames_thinned"], 1U);
  EXPECT_EQ(session_.counters()["detections_left_out"], 300U - 80U) << "25 m each, of 2000 m";
  EXPECT_EQ(refused(), 0U);
}

TEST_F(MappingSessionTest, ADetectionThatZigzagsIsLeftOutAndCounted) {
  drive(10'000, 10'300);
  auto jagged = frame(10'250);
  Detection zigzag = jagged.detections[0];
  zigzag.points.clear();
  for (int i = 0; i < 12; ++i) zigzag.points.emplace_back(i, i % 2 == 0 ? 0.0 : 3.0, 0.0);
  jagged.detections.push_back(zigzag);
  add(jagged);
  EXPECT_EQ(refused(), 0U) << "the rest of the frame is used";
  EXPECT_EQ(session_.counters()["detections_zigzagging"], 1U);
}

TEST_F(MappingSessionTest, DetectionsOfTooLowAConfidenceAreCounted) {
  drive(10'000, 10'300);
  EXPECT_EQ(session_.counters().values().count("detections_unsure"), 0U);
  auto unsure = frame(10'250);
  for (Detection& detection : unsure.detections) detection.confidence = 0.1;
  add(unsure);
  EXPECT_EQ(refused(), 0U);
  EXPECT_EQ(session_.counters()["detections_unsure"], unsure.detections.size());
}

TEST_F(MappingSessionTest, AFrameWithoutPosesIsRefusedInTheEnd) {
  add(frame(10'000));
  EXPECT_EQ(session_.pending(), 1U);
  session_.expire(500 * kMs);
  EXPECT_EQ(session_.pending(), 1U);
  session_.expire(501 * kMs);
  EXPECT_EQ(session_.pending(), 0U);
  EXPECT_EQ(session_.counters()["detections_refused_unsynchronised"], 1U);
}

TEST_F(MappingSessionTest, BadInputIsRefusedWholeAndHarmsNothing) {
  drive(10'000, 12'000);
  const auto before = session_.map().stamp_ns;
  auto bad = frame(11'950);
  bad.detections[1].points[0].x() = std::numeric_limits<double>::quiet_NaN();
  add(bad);
  session_.add(VehiclePose{.stamp_ns = 12'000 * kMs, .orientation = {0, 0, 0, 0}});
  EXPECT_EQ(session_.counters()["detections_refused_coordinate"], 1U);
  EXPECT_EQ(session_.counters()["poses_refused_not_a_rotation"], 1U);
  EXPECT_EQ(session_.map().stamp_ns, before);
  drive(12'000, 12'300);
  EXPECT_EQ(session_.map().stamp_ns, 12'200 * kMs);
}

TEST_F(MappingSessionTest, OneOutlierIsRefusedThreeResetTheMap) {
  drive(10'000, 12'000);
  ASSERT_EQ(session_.map().lanes.size(), 1U);
  const auto id = session_.map().boundaries[0].id;
  session_.add(pose(3'600'000));
  EXPECT_EQ(session_.counters()["poses_refused_outlier"], 1U);
  EXPECT_EQ(session_.map().lanes.size(), 1U);
  fused_ms();

  drive(3'610'000, 3'613'000);
  EXPECT_EQ(session_.counters()["poses_refused_outlier"], 3U);
  EXPECT_EQ(session_.counters()["detections_refused_outlier"], 2U);
  EXPECT_EQ(session_.counters()["map_resets"], 1U)
      << "by the poses; the frames do not say where the vehicle is";
  EXPECT_EQ(session_.take_progress().resets, 1U);
  ASSERT_EQ(session_.map().lanes.size(), 1U);
  EXPECT_GT(session_.map().boundaries[0].id, id);
}

TEST_F(MappingSessionTest, AHeadingThatJumpsResetsTheMap) {
  drive(10'000, 12'000);
  for (const std::int64_t t : {12'000, 12'010, 12'020}) {
    VehiclePose turned = pose(t);
    turned.orientation = Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ());
    session_.add(turned);
  }
  EXPECT_EQ(session_.counters()["poses_refused_outlier"], 2U);
  EXPECT_EQ(session_.counters()["map_resets"], 1U);
  EXPECT_TRUE(session_.map().lanes.empty());
}

TEST_F(MappingSessionTest, AClockThatIsSetBackResetsTheMap) {
  drive(10'000, 12'000);
  drive(11'000, 11'300);
  EXPECT_EQ(session_.counters()["poses_refused_late"], 20U);
  EXPECT_EQ(session_.counters()["map_resets"], 1U);
}

TEST_F(MappingSessionTest, APoseWhoseStampIsAheadLeavesTheMap) {
  drive(10'000, 12'000);
  const auto id = session_.map().boundaries.at(0).id;
  VehiclePose ahead = pose(12'000);
  ahead.stamp_ns += 1'000 * kMs;
  session_.add(ahead);
  drive(12'010, 13'000);
  EXPECT_EQ(session_.counters()["poses_refused_late"], 20U);
  EXPECT_EQ(session_.counters()["map_resets"], 0U);
  EXPECT_EQ(session_.map().boundaries.at(0).id, id);
  EXPECT_EQ(session_.map().stamp_ns, 12'900 * kMs);
}

TEST_F(MappingSessionTest, WhatBecameOfTheOldMapIsNotToldOfTheNewOne) {
  drive(10'000, 12'000);
  session_.add(pose(12'010, 2));
  const auto progress = session_.take_progress();
  EXPECT_EQ(progress.resets, 1U);
  EXPECT_FALSE(progress.fused.empty());
  EXPECT_TRUE(progress.lineage.empty());
}

TEST_F(MappingSessionTest, DeviationsBeyondAllBoundsHarmNothing) {
  drive(10'000, 11'000);
  for (const double stddev_m : {1e155, std::numeric_limits<double>::max()}) {
    for (std::int64_t t = 11'000; t < 12'000; t += 100) {
      DetectionFrame unsure = frame(t + (stddev_m > 1e200 ? 1'000 : 0));
      for (Detection& detection : unsure.detections) detection.stddev_m = {stddev_m, stddev_m};
      add(unsure);
    }
  }
  for (std::int64_t t = 11'000; t < 13'100; t += 10) session_.add(pose(t));
  EXPECT_EQ(session_.counters()["frames_fused"], 30U);
  ASSERT_EQ(session_.map().lanes.size(), 1U);
  for (const Marking& boundary : session_.map().boundaries)
    for (const double stddev_m : boundary.lateral_stddev_m) EXPECT_LT(stddev_m, 11.0);
}

TEST_F(MappingSessionTest, PosesThatPausedGoOnWithTheMap) {
  drive(10'000, 12'000);
  drive(18'900, 21'000);
  EXPECT_EQ(session_.counters()["poses_refused_outlier"], 2U);
  EXPECT_EQ(session_.counters()["map_resets"], 0U) << "a pause of 6.9 s";
  EXPECT_EQ(session_.map().stamp_ns, 20'900 * kMs);
  drive(28'100, 30'000);
  EXPECT_EQ(session_.counters()["map_resets"], 1U) << "7.1 s";
}

TEST_F(MappingSessionTest, ANewSessionResetsTheMapAtOnce) {
  drive(10'000, 12'000);
  add(frame(12'000));  // waits
  session_.add(pose(12'010, 2));
  EXPECT_EQ(session_.map().stamp_ns, 0);
  EXPECT_FALSE(session_.newest_arrival_ns());
  EXPECT_EQ(session_.counters()["map_resets"], 1U);
  drive(12'020, 12'400, 2);
  EXPECT_EQ(session_.counters()["map_resets"], 1U);
  EXPECT_EQ(session_.map().stamp_ns, 12'300 * kMs);
}

TEST_F(MappingSessionTest, WaitingFramesAreBounded) {
  for (int i = 0; i < 100; ++i) add(frame(10'000 + i));
  EXPECT_EQ(session_.pending(), 64U);
  EXPECT_EQ(session_.counters()["frames_dropped_queue_full"], 36U);
}

TEST_F(MappingSessionTest, AnotherSessionGoesOnWhereOneEnded) {
  EXPECT_FALSE(session_.checkpoint());
  drive(10'000, 12'000);
  ASSERT_TRUE(session_.checkpoint());
  MappingSession next{Config{}};
  next.resume(*session_.checkpoint(), session_.mapper_state());
  EXPECT_EQ(next.map().lanes.size(), 1U);
  EXPECT_EQ(next.newest_arrival_ns(), session_.newest_arrival_ns());
  EXPECT_FALSE(next.checkpoint()) << "a map that was only resumed would be kept for ever";
  for (std::int64_t t = 13'000; t < 13'200; t += 10) next.add(pose(t));
  next.add(frame(13'100), 0);
  EXPECT_EQ(next.counters()["frames_fused"], 1U);
  EXPECT_EQ(next.counters()["map_resets"], 0U);
  ASSERT_EQ(next.map().lanes.size(), 1U);
  EXPECT_EQ(next.map().lanes[0].id, session_.map().lanes[0].id);
}

TEST_F(MappingSessionTest, IdsThatWereGivenOutAfterTheCheckpointDoNotComeAgain) {
  drive(10'000, 12'000);
  const auto checkpoint = *session_.checkpoint();
  const MapperState state = session_.mapper_state();
  const auto with_line_at = [](std::int64_t t, double y) {
    DetectionFrame more = frame(t);
    more.detections.push_back(Detection{.confidence = 0.9, .points = {{0.0, y, 0.0}, {25.0, y, 0.0}}});
    return more;
  };
  MappingSession next{Config{}};
  next.resume(checkpoint, state);
  for (std::int64_t t = 12'000; t < 13'000; t += 10) {
    session_.add(pose(t));
    next.add(pose(t));
    if (t % 100 != 0) continue;
    add(with_line_at(t, 5.25));
    next.add(with_line_at(t, -5.25), 0);
  }
  ASSERT_EQ(session_.map().lanes.size(), 2U);
  ASSERT_EQ(next.map().lanes.size(), 2U);
  EXPECT_EQ(next.map().lanes.front().id, session_.map().lanes.front().id);
  EXPECT_GT(next.map().lanes.back().id, session_.map().lanes.back().id + 1'000'000U);
}

TEST_F(MappingSessionTest, AMapOfAnotherPoseFrameIsNotGoneOnWith) {
  drive(10'000, 12'000);
  const auto checkpoint = *session_.checkpoint();
  auto far = pose(12'500);
  far.position.x() += 200.0;
  auto late = pose(60'000);
  late.position.x() = 120.0;
  auto turned = pose(12'100);
  turned.orientation = Eigen::Quaterniond(0.0, 0.0, 0.0, 1.0);
  for (const auto& first : {pose(12'500, 2), pose(11'000), far, late, turned}) {
    MappingSession next{Config{}};
    next.resume(checkpoint, session_.mapper_state());
    next.add(first);
    EXPECT_TRUE(next.map().lanes.empty());
    EXPECT_EQ(next.counters()["map_resets"], 1U);
    EXPECT_FALSE(next.checkpoint());
  }
}

// A replay feeds in one go the messages that the service drained in bites.
TEST_F(MappingSessionTest, TheMapDependsOnTheOrderOfMessagesOnly) {
  MappingSession other{Config{}};
  for (std::int64_t t = 10'000; t < 12'000; t += 10) {
    other.add(pose(t));
    if (t % 100 == 50) other.add(frame(t - 50), t * kMs);
    other.expire(t * kMs);
    if (t % 30 == 0) other.take_progress();
  }
  drive(10'000, 12'000);
  ASSERT_EQ(other.map().boundaries.size(), session_.map().boundaries.size());
  for (std::size_t i = 0; i < other.map().boundaries.size(); ++i) {
    EXPECT_EQ(other.map().boundaries[i].points, session_.map().boundaries[i].points);
    EXPECT_EQ(other.map().boundaries[i].id, session_.map().boundaries[i].id);
  }
}

// Objects wait for the next frame, so that the order in which they come changes nothing.
TEST(Objects, GoIntoTheMapInAnyOrderOfArrival) {
  const auto map_of = [](const std::vector<int>& order, std::uint64_t fused) {
    MappingSession session{Config{}};
    for (std::int64_t t = 10'000; t <= 12'600; t += 10) {
      session.add(pose(t));
      if (t % 500 == 0)
        for (const int k : order) session.add(objects(t - 400 + 100 * k));
      if (t % 500 == 10 && t > 10'500) session.add(frame(t - 10), 0);
    }
    EXPECT_EQ(session.counters()["objects_fused"], fused) << "all but those before the first pose";
    return session.mapper().save();
  };
  const std::string map = map_of({0, 1, 2, 3, 4}, 26);
  EXPECT_EQ(map_of({4, 1, 3, 0, 2}, 26), map);
  EXPECT_NE(map_of({4, 1, 3, 0}, 21), map);
}

TEST(Objects, InTheMapFrameLeaveTheSameTrails) {
  const auto trail_of = [](bool in_map_frame) {
    MappingSession session{Config{}};
    for (std::int64_t t = 10'000; t <= 12'000; t += 10) {
      session.add(pose(t));
      if (t % 100 != 0) continue;
      TrackedObjects cars = objects(t);
      cars.in_map_frame = in_map_frame;
      if (in_map_frame) cars.objects[0].position += pose(t).position;
      session.add(std::move(cars));
      session.add(frame(t), 0);
    }
    return session.mapper_state().trails.all().at(0).points;
  };
  const Polyline wanted = trail_of(false), found = trail_of(true);
  ASSERT_GT(wanted.size(), 10U);
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_TRUE(found[i].isApprox(wanted[i], 1e-9)) << i;
}

TEST_F(MappingSessionTest, MovingObjectsThatLeaveNoTrailAreCounted) {
  drive(10'000, 10'500);
  for (int stamp_ms = 10'510; stamp_ms < 10'550; stamp_ms += 10) {
    TrackedObjects cars = objects(stamp_ms);
    cars.objects.resize(5, cars.objects[0]);
    for (std::size_t i = 0; i < cars.objects.size(); ++i) cars.objects[i].id = i;
    cars.objects[1].heading.setZero();
    cars.objects[2].existence_probability = 0.4;
    cars.objects[3].kind = ObjectKind::unknown;
    cars.objects[4].kind = ObjectKind::pedestrian;
    session_.add(std::move(cars));
  }
  drive(10'500, 11'000);
  EXPECT_EQ(session_.counters()["objects_believed"], 4U);
  EXPECT_EQ(session_.counters()["objects_without_heading"], 4U);
  EXPECT_EQ(session_.counters()["objects_doubted"], 8U);
}

TEST_F(MappingSessionTest, EveryMessageOfObjectsIsAccountedFor) {
  session_.add(objects(9'900));  // before the first pose
  drive(10'000, 11'000);
  session_.add(objects(5'000));  // there are no poses any more, or yet
  for (const int stamp_ms : {10'850, 10'850, 10'950, 14'000}) session_.add(objects(stamp_ms));
  auto broken = objects(10'960);
  broken.objects[0].heading *= 2.0;
  session_.add(broken);
  for (int i = 0; i < 70; ++i) session_.add(objects(11'500 + i));
  drive(11'000, 11'500);
  session_.add(pose(11'500, 2));  // another map
  std::map<std::string, std::uint64_t> counts;
  for (const auto& [name, count] : session_.counters().values())
    if (name.starts_with("objects_")) counts[name] = count;
  EXPECT_EQ(counts, (std::map<std::string, std::uint64_t>{{"objects_dropped_queue_full", 9},
                                                          {"objects_refused_heading", 1},
                                                          {"objects_refused_outlier", 1},
                                                          {"objects_refused_repeated", 1},
                                                          {"objects_refused_reset", 64},
                                                          {"objects_refused_unsynchronised", 1}}));
}

TEST_F(MappingSessionTest, ATurnLeadsTheWayFromItsStampOn) {
  const auto turn = [](int stamp_ms, double distance_m) {
    return NextTurn{.stamp_ns = stamp_ms * kMs, .turn = Linkage::Turn::left, .distance_m = distance_m};
  };
  const auto wish = [&] { return session_.map().way ? session_.map().way->wish : WayWish::straight; };
  session_.add(turn(9'900, 500.0));  // before the first pose
  drive(10'000, 12'000);
  EXPECT_EQ(wish(), WayWish::straight);
  session_.add(turn(12'450, 500.0));
  session_.add(turn(12'450, 500.0));
  session_.add(turn(12'440, -1.0));
  drive(12'000, 12'400);
  EXPECT_EQ(wish(), WayWish::straight) << "it waits for a frame that is not older";
  drive(12'400, 12'600);
  EXPECT_EQ(wish(), WayWish::left);
  std::map<std::string, std::uint64_t> counts;
  for (const auto& [name, count] : session_.counters().values())
    if (name.starts_with("next_turns_")) counts[name] = count;
  EXPECT_EQ(counts, (std::map<std::string, std::uint64_t>{{"next_turns_fused", 1},
                                                          {"next_turns_refused_distance", 1},
                                                          {"next_turns_refused_repeated", 1},
                                                          {"next_turns_refused_unsynchronised", 1}}));
  session_.add(turn(12'700, 500.0));
  drive(13'000, 14'000, 2);  // another map
  EXPECT_EQ(wish(), WayWish::straight);
  EXPECT_EQ(session_.counters()["next_turns_refused_reset"], 1U);
}

}  // namespace
}  // namespace laneloom::session
