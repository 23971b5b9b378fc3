#include "mapping/lines/line_mapper.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "mapping/mapped_road.hpp"
#include "mapping/state.hpp"

namespace laneloom::lines {
namespace {

using test::Drive;
using test::frame_at;
using test::lanelines;
using test::road;
using test::straight;

TEST(LineMapper, AMarkingKnowsWhenItWasFirstAndLastSeen) {
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

TEST(LineMapper, ATrueLineAppearsWithinItsFirstDetectionsAsTentative) {
  Drive drive;
  const LocalMap& map = drive.steps(3);
  EXPECT_EQ(map.boundaries.size(), 3U);
  for (const Marking& boundary : map.boundaries) EXPECT_EQ(boundary.status, ElementStatus::tentative);
  for (const Marking& boundary : drive.steps(10).boundaries)
    EXPECT_EQ(boundary.status, ElementStatus::confirmed);
}

TEST(LineMapper, AStandingCarPublishesWhatItSeesAndConfirmsNothing) {
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

TEST(LineMapper, DrivingMendsTheStyleThatAStandingCarMistook) {
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

TEST(LineMapper, AGhostThatOnlyAStandingCarSawGoesAgain) {
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

TEST(LineMapper, AGhostGoesAgain) {
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

TEST(LineMapper, NetworksThatAreSureAndUnsureAreBelievedAlike) {
  const int usual = frames_until_published(0.6);
  EXPECT_GT(usual, 2);
  EXPECT_LT(usual, 10);
  EXPECT_NEAR(frames_until_published(0.95), usual, 1);
  EXPECT_NEAR(frames_until_published(0.35), usual, 1);
}

TEST(LineMapper, WhatIsOfLowConfidenceIsDroppedUnlessItsNetworkIsUnsure) {
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
    const lines::LineMapper* const fused = MapperState::of(mapper).fusion.lines();
    return fused != nullptr ? fused->lines().size() : 0;
  };
  EXPECT_EQ(lines_with_doubt(0.9, 0.32, true), 5U);
  EXPECT_EQ(lines_with_doubt(0.9, 0.28, true), 4U);
  EXPECT_EQ(lines_with_doubt(0.3, 0.18, true), 5U);
  EXPECT_EQ(lines_with_doubt(0.3, 0.12, true), 4U);
  EXPECT_EQ(lines_with_doubt(0.6, 0.28, false), 4U) << "with nothing known, as told";
  EXPECT_EQ(lines_with_doubt(0.6, 0.32, false), 5U);
}

TEST(LineMapper, WhatLiesBeyondAShoulderIsNoRoad) {
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

TEST(LineMapper, ADoubleThatIsNeverSeenWithItsLineIsNotPublished) {
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

TEST(LineMapper, PiecesOfALineThatIsThenSeenWholeBecomeOneMarkingThatKeepsItsId) {
  Drive drive;
  for (int i = 0; i < 3; ++i) drive.step(road_in_pieces());
  const std::vector<ElementId> pieces = lanelines(drive);
  ASSERT_EQ(pieces.size(), 2U);
  drive.steps(15);
  EXPECT_THAT(lanelines(drive), testing::ElementsAre(pieces[0]));
  drive.steps(80);
  EXPECT_THAT(lanelines(drive), testing::ElementsAre(pieces[0])) << "the older piece is far behind";
}

TEST(LineMapper, AStandingCarJoinsNothing) {
  Drive drive;
  for (int i = 0; i < 3; ++i) drive.step(road_in_pieces());
  for (int i = 0; i < 30; ++i)
    drive.mapper.update(frame_at(drive.x, road(), ++drive.number), test::at(drive.x));
  EXPECT_EQ(lanelines(drive).size(), 2U);
  drive.steps(2);
  EXPECT_EQ(lanelines(drive).size(), 1U);
}

TEST(LineMapper, AfterAResetTheNetworkThatIsHeardIsStillKnown) {
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

TEST(LineMapper, AfterAResetEachFrameOfAStandingCarCountsAgain) {
  Drive drive;
  for (int i = 1; i < 60; ++i) drive.mapper.update(frame_at(drive.x, road(), i), test::at(drive.x));
  drive.mapper.reset();
  for (int i = 60; i < 80; ++i) drive.mapper.update(frame_at(drive.x, road(), i), test::at(drive.x));
  EXPECT_EQ(drive.mapper.map().boundaries.size(), 3U);
}

TEST(LineMapper, ANetworkThatTakesThePlaceOfAForgottenOneIsNotTaughtByItsViews) {
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

}  // namespace
}  // namespace laneloom::lines
