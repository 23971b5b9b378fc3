#include "laneloom/mapper.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "laneloom/lane_graph.hpp"
#include "mapping/mapped_road.hpp"
#include "mapping/state.hpp"

namespace laneloom {
namespace {

using test::detection;
using test::Drive;
using test::frame_at;
using test::lanelines;
using test::road;
using test::straight;

TEST(VoxelMapper, NothingBeforeAlphaNDetectionsThenTheRoad) {
  Drive drive("voxels");
  EXPECT_TRUE(drive.steps(10).boundaries.empty());
  const LocalMap& map = drive.step();
  EXPECT_EQ(map.boundaries.size(), 3U);
  EXPECT_EQ(map.lanes.size(), 2U);
  EXPECT_EQ(map.stamp_ns, 1'100'000'000);
}

class EitherMapper : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, EitherMapper, ::testing::Values("lines", "voxels"),
                         [](const auto& method) { return method.param; });

TEST_P(EitherMapper, LanesHaveBoundariesStylesAndNeighbours) {
  Drive drive(GetParam());
  const LocalMap& map = drive.steps(20);
  ASSERT_EQ(map.lanes.size(), 2U);
  for (const Lane& lane : map.lanes) EXPECT_NEAR(lane.width_m, 3.6, 0.01);
  const auto& lane = map.lanes[0];
  ASSERT_EQ(lane.left_neighbours.size() + lane.right_neighbours.size(), 1U);
  EXPECT_EQ((lane.left_neighbours.empty() ? lane.right_neighbours : lane.left_neighbours)[0].lane,
            map.lanes[1].id);
  for (const Marking& boundary : map.boundaries) {
    ASSERT_EQ(boundary.styles.size(), 1U);
    const bool is_edge = boundary.type == MarkingType::roadedge;
    EXPECT_EQ(boundary.styles[0].style, is_edge ? MarkingStyle::solid : MarkingStyle::dashed);
    EXPECT_GE(boundary.observations, 9U);
  }
}

TEST_P(EitherMapper, IdsLastAsLongAsTheLines) {
  Drive drive(GetParam());
  const LocalMap first = drive.steps(20);
  const LocalMap& later = drive.steps(80);
  ASSERT_EQ(first.boundaries.size(), 3U);
  ASSERT_EQ(later.boundaries.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(first.boundaries[i].id, later.boundaries[i].id);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(first.lanes[i].id, later.lanes[i].id);
  EXPECT_TRUE(later.lineage.empty());
}

TEST_P(EitherMapper, TheWayLeadsAheadFromBesideTheVehicle) {
  Drive drive(GetParam());
  const LocalMap& map = drive.steps(40);
  ASSERT_TRUE(map.way);
  EXPECT_EQ(map.way->wish, WayWish::straight);
  EXPECT_EQ(map.way->stations.front().lane, LaneGraph(map).own_lane(map.T_map_body)->lane.lane->id);
  EXPECT_NEAR(map.way->stations.front().point.x(), map.T_map_body.translation().x(), 0.5);
  EXPECT_GT(map.way->confirmed_m, 20.0);
  drive.x += 1000.0;
  EXPECT_FALSE(drive.step({}).way) << "in no lane";
}

TEST_P(EitherMapper, TheTurnOfTheRouteLeadsTheWayUntilItsPlaceIsPast) {
  Drive drive(GetParam());
  drive.steps(40);
  const std::string saved = drive.mapper.save();
  drive.mapper.add(NextTurn{.turn = Linkage::Turn::left, .distance_m = 10.0}, test::at(drive.x));
  EXPECT_NE(drive.mapper.save(), saved) << "a service that follows knows of it";
  Drive other(GetParam());
  other.mapper.load(drive.mapper.save());
  other.x = drive.x;
  other.number = drive.number;
  for (Drive* each : {&drive, &other}) {
    EXPECT_EQ(each->steps(20).way.value_or(Way{}).wish, WayWish::left);
    EXPECT_EQ(each->steps(10).way.value_or(Way{}).wish, WayWish::straight);
  }
}

TEST_P(EitherMapper, LanesTellWhatTheirEvidenceIs) {
  Drive drive(GetParam());
  const LocalMap& map = drive.steps(40);
  const ElementId own = LaneGraph(map).own_lane(map.T_map_body)->lane.lane->id;
  for (const Lane& lane : map.lanes) {
    EXPECT_TRUE(overlap(lane.evidence, Evidence::markings)) << "a dashed line divides the road";
    EXPECT_TRUE(overlap(lane.evidence, Evidence::edges));
    EXPECT_EQ(overlap(lane.evidence, Evidence::ego_path), lane.id == own);
    EXPECT_EQ(lane.use, Lane::Use::lane);
  }
}

TEST(Mapper, NoEdgeLiesWhereTheVehicleDrove) {
  Drive drive;
  std::vector<Detection> with_ghost = road();
  with_ghost.push_back(detection(MarkingType::roadedge, straight({-50, -0.6, 0.1}, {300, -0.6, 0.1})));
  for (int i = 0; i < 40; ++i) drive.step(with_ghost);
  const auto is_ghost = [](const Marking& marking) {
    return marking.type == MarkingType::roadedge && std::abs(marking.points.front().y()) < 2.0;
  };
  const std::vector<Marking>& markings = drive.mapper.map().markings;
  ASSERT_EQ(std::ranges::count_if(markings, is_ghost), 1);
  const auto ghost = std::ranges::find_if(markings, is_ghost);
  EXPECT_GT(ghost->points.front().x(), drive.x - 3.0) << "it lies ahead alone";
}

TEST_P(EitherMapper, DetectionsThatAreDroppedForTheirConfidenceAreCounted) {
  Drive drive(GetParam());
  auto detections = road();
  detections[0].confidence = detections[1].confidence = 0.29;
  drive.step(detections);
  EXPECT_EQ(drive.mapper.detections_unsure(), 2U);
  drive.step(road());
  EXPECT_EQ(drive.mapper.detections_unsure(), 0U);
}

TEST_P(EitherMapper, AStoplineEndsItsLaneWhenItComesIntoRange) {
  // The lanes end at the stopline: an intersection begins there.
  auto detections = road();
  for (int i = 0; i < 3; ++i) detections[static_cast<std::size_t>(i)].points.back().x() = 60.0;
  Drive drive(GetParam());
  for (int i = 0; i < 45; ++i) drive.step(detections);
  const LocalMap& map = drive.mapper.map();
  ASSERT_EQ(map.stoplines.size(), 1U);
  ASSERT_EQ(map.stoplines[0].lanes.size(), 1U);
  EXPECT_GT(map.stoplines[0].heading.x(), 0.9);
}

TEST_P(EitherMapper, WhatLeavesTheRangeGoes) {
  Drive drive(GetParam());
  const LocalMap before = drive.steps(30);
  const std::size_t published = before.boundaries.size() + before.stoplines.size() + before.lanes.size();
  drive.x += 1000.0;
  const LocalMap& map = drive.step({});
  EXPECT_TRUE(map.boundaries.empty());
  EXPECT_TRUE(map.markings.empty());
  const Fusion& fusion = MapperState::of(drive.mapper).fusion;
  EXPECT_TRUE(fusion.lines() == nullptr || fusion.lines()->lines().empty());
  EXPECT_TRUE(fusion.voxels() == nullptr || fusion.voxels()->map().voxels.living() == 0U);
  EXPECT_EQ(map.lineage.size(), published);  // all retired
}

TEST_P(EitherMapper, EverythingPublishedLiesInTheRange) {
  Drive drive(GetParam());
  const double margin_m = GetParam() == "lines" ? RangeConfig{}.margin_forward_m : 0.0;  // published, too
  for (int i = 0; i < 60; ++i) {
    for (const Marking& instance : drive.step().markings) {
      for (const Point& p : instance.points) {
        const Point body = drive.mapper.map().T_map_body.inverse() * p;
        EXPECT_GE(body.x(), -5.0 - margin_m - 1e-6);
        EXPECT_LE(body.x(), 30.0 + margin_m + 1e-6);
      }
    }
  }
}

TEST(VoxelMapper, EvidenceIsGatheredBeforeTheRangeIsEntered) {
  // With the margin, a line is in the map as far as the range goes; without it, it would lag by alpha_n
  // frames.
  Drive drive("voxels");
  double front = 0.0;
  for (const Point& p : drive.steps(60).boundaries[0].points) front = std::max(front, p.x() - drive.x);
  EXPECT_GT(front, 28.5);
}

TEST_P(EitherMapper, BridgeAndRoadBelowStayApart) {
  auto detections = road();
  detections.pop_back();
  const auto below = detections.size();
  for (std::size_t i = 0; i < below; ++i) {
    detections.push_back(detections[i]);
    for (Point& p : detections.back().points) p.z() += 6.0;
  }
  Drive drive(GetParam());
  for (int i = 0; i < 20; ++i) drive.step(detections);
  EXPECT_EQ(drive.mapper.map().boundaries.size(), 6U);
  ASSERT_EQ(drive.mapper.map().lanes.size(), 4U);
  for (const Lane& lane : drive.mapper.map().lanes) {
    const double height_m = lane.centerline.front().z();
    EXPECT_LT(std::min(std::abs(height_m - 0.1), std::abs(height_m - 6.1)), 0.5) << "half-way up";
  }
}

TEST(LineMapper, TheKerbOfATrafficIslandIsInTheMap) {
  auto detections = road();
  detections.push_back(
      detection(MarkingType::roadedge, {{15, 5, 0}, {29, 5, 0}, {29, 7, 0}, {15, 7, 0}, {15, 5, 0}}));
  Drive drive;
  for (int i = 0; i < 5; ++i) drive.step(detections);
  const auto on_island = [](const Marking& marking) {
    return std::ranges::all_of(marking.points, [](const Point& point) { return point.y() > 4.5; });
  };
  EXPECT_TRUE(std::ranges::any_of(drive.mapper.map().boundaries, on_island));
  EXPECT_EQ(drive.mapper.map().lanes.size(), 2U);
}

TEST_P(EitherMapper, ANetworkWithoutStoplinesIsANormalCase) {
  auto detections = road();
  detections.pop_back();
  Drive drive(GetParam());
  for (int i = 0; i < 20; ++i) drive.step(detections);
  EXPECT_EQ(drive.mapper.map().lanes.size(), 2U);
  EXPECT_TRUE(drive.mapper.map().stoplines.empty());
}

TEST_P(EitherMapper, AfterAResetNoIdComesAgain) {
  Drive drive(GetParam());
  ElementId highest = 0;
  for (const Lane& lane : drive.steps(20).lanes) highest = std::max(highest, lane.id);
  drive.mapper.reset();
  EXPECT_TRUE(drive.mapper.map().boundaries.empty());
  for (const Marking& boundary : drive.steps(20).boundaries) EXPECT_GT(boundary.id, highest);
}

TEST_P(EitherMapper, TellsTheObserverItsStagesInOrder) {
  struct Recorder : StageObserver {
    void update_begins() override { ++updates; }
    void stage_done(Stage stage) override { stages.push_back(stage); }
    std::vector<Stage> stages;
    int updates = 0;
  } recorder;
  Drive drive(GetParam());
  drive.step(road(), &recorder);
  EXPECT_EQ(recorder.updates, 1);
  EXPECT_TRUE(std::ranges::is_sorted(recorder.stages));
  EXPECT_EQ(recorder.stages.size(), GetParam() == "lines" ? 10U : 11U);
  EXPECT_EQ(recorder.stages.front(), Stage::preprocess);
  EXPECT_EQ(recorder.stages.back(), Stage::way);
  EXPECT_STREQ(name(Stage::linkages), "linkages");
}

/// Detections with noise, so that instances come, merge and go.
std::vector<Detection> noisy(std::mt19937& random) {
  std::normal_distribution<double> offset(0.0, 0.15);
  std::bernoulli_distribution seen(0.85);
  std::vector<Detection> detections;
  for (Detection d : road()) {
    if (!seen(random)) continue;
    const Point shift(offset(random), offset(random), 0.0);
    for (Point& p : d.points) p += shift;
    detections.push_back(std::move(d));
  }
  return detections;
}

TEST_P(EitherMapper, SavedLoadedAndContinuedIsTheSameToTheLastBit) {
  Drive one(GetParam());
  std::mt19937 random(11);
  for (int i = 0; i < 80; ++i) one.step(noisy(random));
  const std::string saved = one.mapper.save();

  Drive two(GetParam());
  two.mapper.load(saved);
  two.x = one.x;
  two.number = one.number;
  EXPECT_EQ(two.mapper.save(), saved);
  for (int i = 0; i < 120; ++i) {
    const auto detections = noisy(random);
    one.step(detections);
    two.step(detections);
  }
  EXPECT_FALSE(one.mapper.map().lanes.empty());
  EXPECT_EQ(one.mapper.save(), two.mapper.save());
}

TEST(MapperState, HowEndsThatLieSideBySideWereSeenIsSaved) {
  std::vector<Detection> first = road(), second = road();
  first[1].points = straight({-50, 0.1, 0.1}, {16, 0.1, 0.1});
  second[1].points = straight({10, 0.8, 0.1}, {300, 0.8, 0.1});
  // The lines are surer than the edges, so that few frames suffice.
  for (std::vector<Detection>* const frame : {&first, &second})
    for (Detection& detection : *frame)
      detection.confidence = detection.type == MarkingType::laneline ? 1.0 : 0.6;
  Drive one, two;
  for (int i = 0; i < 6; ++i) one.step(i % 2 == 0 ? first : second);
  ASSERT_EQ(lanelines(one).size(), 2U);
  two.mapper.load(one.mapper.save());
  two.x = one.x;
  two.number = one.number;
  one.step(second);
  two.step(second);
  EXPECT_EQ(lanelines(one).size(), 1U);
  EXPECT_EQ(lanelines(two).size(), 1U);
}

TEST(MapperState, DamagedBytesAreRefused) {
  Drive drive;
  drive.steps(20);
  const std::string saved = drive.mapper.save();
  Drive other("voxels");
  EXPECT_THROW(other.mapper.load(saved), std::runtime_error) << "of another method";
  EXPECT_THROW(drive.mapper.load(""), std::runtime_error);
  EXPECT_THROW(drive.mapper.load("something else, long enough"), std::runtime_error);
  EXPECT_THROW(drive.mapper.load(saved.substr(0, saved.size() / 2)), std::runtime_error);
  EXPECT_EQ(drive.mapper.save(), saved) << "the mapper is as it was";
}

TEST(MapperState, RemembersTheLastMetresOfTheVehiclesWay) {
  MapperState state({});
  for (int i = 0; i <= 1000; ++i) state.drive_through({0.1 * i, 0, 0});
  ASSERT_EQ(state.driven.size(), 30U);
  EXPECT_NEAR(state.driven.back().x(), 100.0, 2.0);
  EXPECT_NEAR(state.driven.back().x() - state.driven.front().x(), 58.0, 2.0);
}

TEST_P(EitherMapper, TheWayMovesWithPosesThatJump) {
  const MapperConfig config{.method = GetParam() == "voxels" ? FusionMethod::voxels : FusionMethod::lines};
  MapperState state(config);
  state.map.way.emplace().stations = {{.point = {1, 0, 0}}, {.point = {2, 0, 0}}};
  state.drive_through({1, 0, 0});
  const Eigen::Isometry3d motion = test::at(5, 3, 0.5);
  state.follow(motion, config);
  EXPECT_TRUE(state.driven.front().isApprox(motion * Point(1, 0, 0)));
  for (std::size_t i = 0; i < 2; ++i) {
    const WayStation& station = state.map.way->stations[i];
    EXPECT_NEAR((station.point - motion * Point(1.0 + static_cast<double>(i), 0, 0)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(station.heading_rad, 0.5, 1e-12);
  }
}

/// Lets the vehicle stand for some frames. Returns the number of the first one after which the map has
/// `lines` markings. 0: there is none.
int stand(int frames, const std::vector<Detection>& detections, std::size_t lines, Drive& drive) {
  int first = 0;
  for (int i = 1; i <= frames; ++i) {
    const LocalMap& map =
        drive.mapper.update(frame_at(drive.x, detections, ++drive.number), test::at(drive.x));
    if (first == 0 && map.markings.size() == lines) first = i;
  }
  return first;
}

TEST(LineMapper, AStandingVehicleSeesWhatIsNewAndWhatIsGoneWithinSeconds) {
  Drive drive;
  drive.steps(40);
  stand(100, road(), 0, drive);
  auto with_new_line = road();
  with_new_line.push_back(
      test::detection(MarkingType::laneline, straight({drive.x + 5, 9, 0.1}, {drive.x + 20, 9, 0.1})));
  const std::size_t known = drive.mapper.map().markings.size();
  const int shown = stand(100, with_new_line, known + 1, drive);
  EXPECT_GT(shown, 0);
  EXPECT_LE(shown, 60);
  const int gone = stand(100, road(), known, drive);
  EXPECT_GT(gone, 0);
  EXPECT_LE(gone, 80);
}

TEST(LineMapper, AStandingVehicleFusesEachFrameWhileAnotherOneDrives) {
  Drive drive;
  drive.steps(40);
  stand(55, road(), 0, drive);
  const LocalMap& map = drive.mapper.map();
  const auto sees_now = [&] {
    return std::ranges::count(map.markings, map.stamp_ns, &Marking::last_seen_ns) > 0;
  };
  TrackedObject car{
      .id = 1, .kind = ObjectKind::car, .position = {5, 5.25, 0}, .heading = {-1, 0, 0}, .speed_mps = 10};
  for (int i = 0; i < 5; ++i) {
    car.position.x() -= 1.1;
    drive.mapper.add({.stamp_ns = map.stamp_ns + 100'000'000, .session_id = 1, .objects = {car}},
                     test::at(drive.x));
    stand(1, road(), 0, drive);
    EXPECT_TRUE(sees_now()) << i;
  }
  car.speed_mps = 0.0;
  int fused = 0;
  for (int i = 0; i < 8; ++i) {
    drive.mapper.add({.stamp_ns = map.stamp_ns + 100'000'000, .session_id = 1, .objects = {car}},
                     test::at(drive.x));
    stand(1, road(), 0, drive);
    fused += sees_now() ? 1 : 0;
  }
  EXPECT_LE(fused, 1) << "nothing moves";
}

TEST(LineMapper, TheMapOfAStandingVehicleKeepsUpWithItsPoses) {
  Drive drive;
  drive.steps(40);
  stand(50, road(), 0, drive);
  const LocalMap before = drive.mapper.map();
  const LocalMap& map = drive.mapper.update(frame_at(drive.x, {}, ++drive.number), test::at(drive.x + 0.05));
  EXPECT_EQ(map.stamp_ns, before.stamp_ns + 100'000'000);
  EXPECT_EQ(map.T_map_body.translation().x(), drive.x + 0.05);
  EXPECT_TRUE(map.lineage.empty());
  ASSERT_TRUE(map.way);
  EXPECT_EQ(map.markings.size(), before.markings.size());
  drive.mapper.update(frame_at(drive.x, {}, drive.number - 1), test::at(drive.x));
  EXPECT_EQ(map.stamp_ns, before.stamp_ns + 100'000'000) << "a late frame sets no pose";
  EXPECT_EQ(map.T_map_body.translation().x(), drive.x + 0.05);
}

TEST(LineMapper, StandingIsTheSameToTheLastBitAfterALoad) {
  Drive one, two;
  one.steps(40);
  stand(33, road(), 0, one);
  two.mapper.load(one.mapper.save());
  two.x = one.x;
  two.number = one.number;
  for (int i = 0; i < 30; ++i) {
    stand(1, road(), 0, one);
    stand(1, road(), 0, two);
    EXPECT_EQ(one.mapper.save(), two.mapper.save());
  }
}

TEST_P(EitherMapper, MemoryIsFlatOverALongDriveAndALongStand) {
  Drive drive(GetParam());
  drive.steps(100);
  const voxels::VoxelMapper* voxels = MapperState::of(drive.mapper).fusion.voxels();
  const auto slots_now = [&] { return voxels != nullptr ? voxels->map().voxels.slots() : 0; };
  const voxels::VoxelId slots = slots_now();
  const std::size_t bytes = drive.mapper.save().size();
  drive.steps(150);
  const voxels::VoxelId slots_before_stand = slots_now();
  const auto detections = road();
  for (int i = 0; i < 2000; ++i)
    drive.mapper.update(frame_at(drive.x, detections, ++drive.number), test::at(drive.x));
  EXPECT_EQ(drive.mapper.map().lanes.size(), 2U);
  if (voxels != nullptr) {
    EXPECT_LE(slots_before_stand, slots + slots / 10);
    EXPECT_LE(voxels->map().co_observation.stored_entries(), 5'000'000U);
  } else {
    EXPECT_LE(drive.mapper.save().size(), bytes + bytes / 10);
  }
}

}  // namespace
}  // namespace laneloom