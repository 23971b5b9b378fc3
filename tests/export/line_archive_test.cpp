#include "export/line_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace laneloom::exports {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::SizeIs;

constexpr ElementId kId = 7, kOther = 8;

Marking line(double from_m, double to_m, double y, double stddev_m, ElementId id = kId) {
  return {.id = id,
          .points = {{from_m, y, 0}, {to_m, y, 0}},
          .styles = {{{0.0, to_m - from_m}, MarkingStyle::solid}},
          .lateral_stddev_m = {stddev_m, stddev_m},
          .existence_probability = 0.9,
          .observations = 100};
}

TEST(LineArchive, PiecesThatOverlapAreOneLine) {
  LineArchive archive;
  archive.add({.marking = line(0, 20, 0, 0.1)});
  archive.add({.marking = line(17, 40, 0, 0.1)});
  const std::vector<Marking> markings = archive.markings();
  ASSERT_THAT(markings, SizeIs(1));
  EXPECT_NEAR(length(markings[0].points), 40.0, 0.1);
  EXPECT_EQ(markings[0].points.size(), markings[0].lateral_stddev_m.size());
  ASSERT_THAT(markings[0].styles, SizeIs(1));
  EXPECT_EQ(markings[0].styles[0].style, MarkingStyle::solid);
}

TEST(LineArchive, ALineGrowsAtEitherEndWhicheverWayAPieceRuns) {
  LineArchive archive;
  archive.add({.marking = line(0, 20, 0, 0.1)});
  archive.add({.marking = line(3, -20, 0, 0.1)});
  archive.add({.marking = line(40, 17, 0, 0.1)});
  const std::vector<Marking> markings = archive.markings();
  ASSERT_THAT(markings, SizeIs(1));
  EXPECT_NEAR(length(markings[0].points), 60.0, 0.1) << "it does not go back and forth";
}

TEST(LineArchive, ASecondPassIsWeighedByItsDeviation) {
  LineArchive archive;
  archive.add({.marking = line(0, 20, 0.0, 0.1), .pass = 0});
  archive.add({.marking = line(0, 20, 0.5, 0.2), .pass = 1});
  const std::vector<Marking> markings = archive.markings();
  ASSERT_THAT(markings, SizeIs(1));
  for (const Point& point : markings[0].points) EXPECT_NEAR(point.y(), 0.1, 1e-6);
  EXPECT_THAT(markings[0].lateral_stddev_m, Each(DoubleNear(0.1, 1e-9)));
}

TEST(LineArchive, LinesThatOneMapHasSideBySideStayTwo) {
  LineArchive archive;
  for (const double from_m : {0.0, 17.0}) {
    archive.add({line(from_m, from_m + 20, 0.0, 0.1, kId), 0, {kOther}});
    archive.add({line(from_m, from_m + 20, 0.2, 0.1, kOther), 0, {kId}});
  }
  const std::vector<Marking> markings = archive.markings();
  ASSERT_THAT(markings, SizeIs(2));
  for (const Marking& marking : markings) EXPECT_NEAR(length(marking.points), 37.0, 0.1);
}

TEST(LineArchive, OfTwoThatWereSeldomSeenTogetherOneIsAShadow) {
  LineArchive archive;
  archive.add({line(0, 40, 0.0, 0.1, kId), 0, {}});
  archive.add({line(5, 15, 0.3, 0.1, kOther), 0, {kId}});
  EXPECT_THAT(archive.markings(), SizeIs(2));
  archive.add({line(5, 15, 0.3, 0.1, kOther), 0, {}});
  EXPECT_THAT(archive.markings(), SizeIs(1));
}

TEST(LineArchive, WhatLiesFurtherAsideOrAboveIsAnother) {
  LineArchive archive;
  archive.add({.marking = line(0, 20, 0.0, 0.1)});
  archive.add({.marking = line(0, 20, 3.5, 0.1)});
  Marking bridge = line(0, 20, 0.0, 0.1);
  for (Point& point : bridge.points) point.z() = 6.0;
  archive.add({.marking = bridge});
  EXPECT_THAT(archive.markings(), SizeIs(3));
}

TEST(LineArchive, WhatIsDoubtfulIsLeftOut) {
  LineArchive archive;
  Marking tentative = line(0, 20, 0, 0.1), seldom = line(0, 20, 10, 0.1), weak = line(0, 20, 20, 0.1);
  tentative.status = ElementStatus::tentative;
  seldom.observations = 3;
  weak.existence_probability = 0.5;
  for (const Marking& doubtful : {tentative, seldom, weak}) archive.add({.marking = doubtful});
  EXPECT_THAT(archive.markings(), SizeIs(0));
}

TEST(LineArchive, AStoplineIsTheBestAtTheMeanPlace) {
  LineArchive archive;
  Marking near = line(0, 4, 0.0, 0.1), far = line(0, 4, 0.8, 0.4), next = line(0, 4, 8.0, 0.1);
  for (Marking* stopline : {&far, &near, &next}) {
    stopline->type = MarkingType::stopline;
    archive.add({.marking = *stopline});
  }
  const std::vector<Marking> markings = archive.markings();
  ASSERT_THAT(markings, SizeIs(2));
  ASSERT_THAT(markings[0].points, SizeIs(2));
  for (const Point& point : markings[0].points) EXPECT_NEAR(point.y(), 0.8 / 17.0, 1e-9);
}

}  // namespace
}  // namespace laneloom::exports
