#include "laneloom/mapper.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "mapping/shapes.hpp"
#include "mapping/state.hpp"

namespace laneloom {
namespace {

using test::straight;

constexpr double kStep_m = 1.0;  // 10 m/s at 10 Hz

/// A road along x with two lanes of 3.6 m between voxel centres, a dashed line between them, and a stopline
/// at x = 60.
std::vector<Detection> road() {
  return {
      test::detection(MarkingType::roadedge, straight({-50, 3.7, 0.1}, {300, 3.7, 0.1}), MarkingStyle::solid),
      test::detection(MarkingType::laneline, straight({-50, 0.1, 0.1}, {300, 0.1, 0.1}),
                      MarkingStyle::dashed),
      test::detection(MarkingType::roadedge, straight({-50, -3.5, 0.1}, {300, -3.5, 0.1}),
                      MarkingStyle::solid),
      test::detection(MarkingType::stopline, straight({60, -3.5, 0.1}, {60, 0.1, 0.1}))};
}

DetectionFrame frame_at(double x, std::vector<Detection> in_map, int number) {
  DetectionFrame frame;
  frame.stamp_ns = number * 100'000'000LL;
  frame.sequence = static_cast<std::uint64_t>(number);
  for (Detection& d : in_map) {
    for (Point& p : d.points) p = test::at(x).inverse() * p;
  }
  frame.detections = std::move(in_map);
  return frame;
}

MapperConfig with_method(const std::string& method) {
  MapperConfig config;
  config.method = method == "voxels" ? FusionMethod::voxels : FusionMethod::lines;
  return config;
}

class Drive {
 public:
  explicit Drive(const std::string& method = "lines") : mapper(with_method(method)) {}
  const LocalMap& step(const std::vector<Detection>& detections = road(), StageObserver* observer = nullptr) {
    x += kStep_m;
    return mapper.update(frame_at(x, detections, ++number), test::at(x), observer);
  }
  const LocalMap& steps(int count) {
    for (int i = 0; i < count; ++i) step();
    return mapper.map();
  }
  Mapper mapper;
  double x = 0.0;
  int number = 0;
};

TEST(Mapper, AMarkingKnowsWhenItWasFirstAndLastSeen) {
  Drive drive;
  drive.steps(5);
  std::vector<Detection> without_line = road();
  without_line.erase(without_line.begin() + 1);
  const LocalMap& map = drive.step(without_line);
  const auto line = std::ranges::find(map.markings, MarkingType::laneline, &Marking::type);
  ASSERT_NE(line, map.markings.end());
  EXPECT_EQ(line->first_seen_ns, 100'000'000);
  EXPECT_EQ(line->last_seen_ns, 500'000'000);
}

TEST(Mapper, ATrueLineAppearsWithinItsFirstDetectionsAsTentative) {
  Drive drive;
  const LocalMap& map = drive.steps(3);
  EXPECT_EQ(map.boundaries.size(), 3U);
  for (const Marking& boundary : map.boundaries) EXPECT_EQ(boundary.status, ElementStatus::tentative);
  for (const Marking& boundary : drive.steps(10).boundaries)
    EXPECT_EQ(boundary.status, ElementStatus::confirmed);
}

TEST(Mapper, AStandingCarPublishesWhatItSeesAndConfirmsNothing) {
  Drive drive;
  drive.step();
  for (int i = 2; i < 200; ++i) drive.mapper.update(frame_at(drive.x, road(), i), test::at(drive.x));
  EXPECT_EQ(drive.mapper.map().boundaries.size(), 3U);
  for (const Marking& boundary : drive.mapper.map().boundaries)
    EXPECT_EQ(boundary.status, ElementStatus::tentative);
  drive.number = 200;
  for (const Marking& boundary : drive.steps(10).boundaries)
    EXPECT_EQ(boundary.status, ElementStatus::confirmed);
}

TEST(Mapper, DrivingMendsTheStyleThatAStandingCarMistook) {
  Drive drive;
  auto mistaken = road();
  mistaken[1].style = MarkingStyle::solid;
  drive.step(mistaken);
  for (int i = 2; i < 200; ++i) drive.mapper.update(frame_at(drive.x, mistaken, i), test::at(drive.x));
  drive.number = 200;
  const LocalMap& map = drive.steps(10);
  const auto line = std::ranges::find(map.markings, MarkingType::laneline, &Marking::type);
  ASSERT_NE(line, map.markings.end());
  for (const StyleRange& range : line->styles) EXPECT_EQ(range.style, MarkingStyle::dashed);
}

TEST(Mapper, AGhostThatOnlyAStandingCarSawGoesAgain) {
  Drive drive;
  drive.steps(20);
  auto with_ghost = road();
  with_ghost.push_back(
      test::detection(MarkingType::laneline, straight({drive.x + 5, 8, 0.1}, {drive.x + 15, 9, 0.1})));
  const auto stand = [&](const std::vector<Detection>& detections, int frames) {
    for (int i = 0; i < frames; ++i)
      drive.mapper.update(frame_at(drive.x, detections, ++drive.number), test::at(drive.x));
    return drive.mapper.map().boundaries.size();
  };
  ASSERT_EQ(stand(with_ghost, 20), 4U);
  EXPECT_EQ(stand(road(), 60), 3U);
  EXPECT_EQ(stand({}, 300), 3U) << "standing forgets nothing that was driven along";
}

TEST(Mapper, AGhostGoesAgain) {
  Drive drive;
  drive.steps(20);
  auto with_ghost = road();
  with_ghost.push_back(test::detection(MarkingType::laneline, straight({45, 8, 0.1}, {55, 9, 0.1})));
  for (int i = 0; i < 5; ++i) drive.step(with_ghost);
  ASSERT_EQ(drive.mapper.map().boundaries.size(), 4U);
  for (int i = 0; i < 30; ++i) drive.step();
  EXPECT_EQ(drive.mapper.map().boundaries.size(), 3U);
}

/// Number of frames in which a new line has to be seen until it is published, by a network that has given all
/// lines of a road `confidence` for a while.
int frames_until_published(double confidence) {
  const auto told = [=](std::vector<Detection> detections) {
    for (Detection& detection : detections) detection.confidence = confidence;
    return detections;
  };
  Drive drive;
  for (int i = 0; i < 60; ++i) drive.step(told(road()));
  auto with_new_line = road();
  with_new_line.push_back(
      test::detection(MarkingType::laneline, straight({drive.x, 12, 0.1}, {drive.x + 15, 12, 0.1})));
  const std::size_t known = drive.mapper.map().markings.size();
  int frames = 1;
  while (frames < 30 && drive.step(told(with_new_line)).markings.size() <= known) ++frames;
  return frames;
}

TEST(Mapper, NetworksThatAreSureAndUnsureAreBelievedAlike) {
  const int usual = frames_until_published(0.6);
  EXPECT_GT(usual, 2);
  EXPECT_LT(usual, 10);
  EXPECT_NEAR(frames_until_published(0.95), usual, 1);
  EXPECT_NEAR(frames_until_published(0.35), usual, 1);
}

TEST(Mapper, WhatIsOfLowConfidenceIsDroppedUnlessItsNetworkIsUnsure) {
  const auto lines_with_doubt = [](double usual, double doubtful, bool learn) {
    MapperConfig config;
    config.fusion.learn = learn;
    Mapper mapper{config};
    auto detections = road();
    for (Detection& detection : detections) detection.confidence = usual;
    detections.push_back(test::detection(MarkingType::laneline, straight({-50, 8, 0}, {300, 8, 0})));
    const auto drive = [&](int from, int to) {
      for (int i = from; i < to; ++i) mapper.update(frame_at(i, detections, i + 1), test::at(i));
    };
    detections.back().confidence = 0.0;
    drive(0, 60);
    detections.back().confidence = doubtful;
    drive(60, 61);
    const lines::LineMapper* const fused = mapper.state().fusion.lines();
    return fused != nullptr ? fused->lines().size() : 0;
  };
  EXPECT_EQ(lines_with_doubt(0.9, 0.32, true), 5U);
  EXPECT_EQ(lines_with_doubt(0.9, 0.28, true), 4U);
  EXPECT_EQ(lines_with_doubt(0.3, 0.18, true), 5U);
  EXPECT_EQ(lines_with_doubt(0.3, 0.12, true), 4U);
  EXPECT_EQ(lines_with_doubt(0.6, 0.28, false), 4U) << "with nothing known, as told";
  EXPECT_EQ(lines_with_doubt(0.6, 0.32, false), 5U);
}

TEST(Mapper, WhatLiesBeyondAShoulderIsNoRoad) {
  const auto along = [](MarkingType type, double y) {
    return test::detection(type, straight({-50, y, 0}, {300, y, 0}), MarkingStyle::solid);
  };
  const std::vector<Detection> detections{
      along(MarkingType::laneline, -1.8), along(MarkingType::laneline, 1.8),
      along(MarkingType::roadedge, 4.4), along(MarkingType::roadedge, 13.4)};
  Drive drive;
  for (int i = 0; i < 20; ++i) drive.step(detections);
  EXPECT_EQ(drive.mapper.map().boundaries.size(), 4U);
  EXPECT_EQ(drive.mapper.map().lanes.size(), 1U);
}

TEST(Mapper, ADoubleThatIsNeverSeenWithItsLineIsNotPublished) {
  Drive drive;
  drive.steps(15);
  auto displaced = road();
  for (Point& p : displaced[1].points) p.y() += 0.8;
  for (int i = 0; i < 40; ++i)
    EXPECT_EQ(drive.step(i % 2 == 0 ? displaced : road()).boundaries.size(), 3U) << i;
}

/// The road with its laneline in two pieces, the second one 2.5 m beyond the first.
std::vector<Detection> road_in_pieces() {
  std::vector<Detection> pieces = road();
  pieces[1].points = straight({-50, 0.1, 0.1}, {10, 0.1, 0.1});
  pieces.push_back(test::detection(MarkingType::laneline, straight({12.5, 0.1, 0.1}, {300, 0.1, 0.1})));
  return pieces;
}

/// The ids of the lanelines of a map.
std::vector<ElementId> lanelines(const Drive& drive) {
  std::vector<ElementId> ids;
  for (const Marking& marking : drive.mapper.map().markings)
    if (marking.type == MarkingType::laneline) ids.push_back(marking.id);
  return ids;
}

TEST(Mapper, PiecesOfALineThatIsThenSeenWholeBecomeOneMarkingThatKeepsItsId) {
  Drive drive;
  for (int i = 0; i < 3; ++i) drive.step(road_in_pieces());
  const std::vector<ElementId> pieces = lanelines(drive);
  ASSERT_EQ(pieces.size(), 2U);
  drive.steps(15);
  EXPECT_THAT(lanelines(drive), testing::ElementsAre(pieces[0]));
  drive.steps(80);
  EXPECT_THAT(lanelines(drive), testing::ElementsAre(pieces[0])) << "the older piece is far behind";
}

TEST(Mapper, AStandingCarJoinsNothing) {
  Drive drive;
  for (int i = 0; i < 3; ++i) drive.step(road_in_pieces());
  for (int i = 0; i < 30; ++i)
    drive.mapper.update(frame_at(drive.x, road(), ++drive.number), test::at(drive.x));
  EXPECT_EQ(lanelines(drive).size(), 2U);
  drive.steps(2);
  EXPECT_EQ(lanelines(drive).size(), 1U);
}

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
  const std::size_t published = before.boundaries.size() + before.stoplines.size();
  drive.x += 1000.0;
  const LocalMap& map = drive.step({});
  EXPECT_TRUE(map.boundaries.empty());
  EXPECT_TRUE(map.markings.empty());
  const Fusion& fusion = drive.mapper.state().fusion;
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

TEST(Mapper, AfterAResetTheNetworkThatIsHeardIsStillKnown) {
  Mapper mapper{MapperConfig{}};
  int number = 0;
  const auto see = [&](const std::string& source) {
    DetectionFrame frame = frame_at(number, road(), number + 1);
    frame.source = source;
    mapper.update(frame, test::at(number));
    ++number;
  };
  for (const char* gone : {"a", "b", "c", "d", "e", "f", "g"}) see(gone);
  for (int i = 0; i < 20; ++i) see("heard");
  mapper.reset();
  see("heard");
  see("new");
  EXPECT_FALSE(mapper.learned("heard").empty());
  EXPECT_TRUE(mapper.learned("a").empty());
}

TEST(Mapper, ANetworkThatTakesThePlaceOfAForgottenOneIsNotTaughtByItsViews) {
  const auto learned_by_the_ninth = [](double first_errs_m) {
    Mapper mapper{MapperConfig{}};
    int number = 0;
    const auto see = [&](const std::string& source, double x, double from_m, double to_m, double y) {
      const Polyline line = straight({from_m, y, 0}, {to_m, y, 0}, 31);
      DetectionFrame frame = frame_at(x, {test::detection(MarkingType::laneline, line)}, ++number);
      frame.source = source;
      mapper.update(frame, test::at(x));
    };
    for (int i = 0; i < 5; ++i) see("first", i, 15, 45, first_errs_m);
    for (const char* silent : {"b", "c", "d", "e", "f", "g", "h"}) see(silent, 5, -30, -20, 8);
    for (int i = 10; i < 40; ++i) see("ninth", i, i, i + 8, 0);
    auto learned = mapper.learned("ninth");
    std::erase_if(learned, [](const auto& value) { return !value.first.starts_with("stddev"); });
    return learned;
  };
  ASSERT_FALSE(learned_by_the_ninth(0.4).empty());
  EXPECT_EQ(learned_by_the_ninth(0.4), learned_by_the_ninth(0.0));
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
  EXPECT_EQ(recorder.stages.size(), GetParam() == "lines" ? 9U : 10U);
  EXPECT_EQ(recorder.stages.front(), Stage::preprocess);
  EXPECT_EQ(recorder.stages.back(), Stage::linkages);
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

TEST_P(EitherMapper, MemoryIsFlatOverALongDriveAndALongStand) {
  Drive drive(GetParam());
  drive.steps(100);
  const voxels::VoxelMapper* voxels = drive.mapper.state().fusion.voxels();
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
