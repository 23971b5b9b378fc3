#include "mapping/markings/dashes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mapping/shapes.hpp"

namespace laneloom::markings {
namespace {

using test::straight;

ObservedMarking piece(const Point& from, const Point& to) {
  return {.type = MarkingType::laneline, .confidence = 0.8, .points = straight(from, to), .belief = 0.5};
}

/// Dashes of 3 m with gaps of 9 m, as on a motorway.
std::vector<ObservedMarking> row(double y, int count) {
  std::vector<ObservedMarking> dashes;
  for (int i = 0; i < count; ++i) dashes.push_back(piece({12.0 * i, y, 0}, {12.0 * i + 3.0, y, 0}));
  return dashes;
}

TEST(JoinDashes, MakesOneDashedLineOfARow) {
  const auto lines = join_dashes(row(1.8, 3));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].style, MarkingStyle::dashed);
  EXPECT_EQ(lines[0].points.front(), Point(0, 1.8, 0));
  EXPECT_EQ(lines[0].points.back(), Point(27, 1.8, 0));
  EXPECT_DOUBLE_EQ(lines[0].belief, 1.0 - 0.5 * 0.5 * 0.5);
}

/// Rows of motorways (6 m and gaps of 12 m) and of their ramps, and of two lanes in a bend.
TEST(JoinDashes, FollowsABend) {
  struct Row {
    double radius_m, dash_m, gap_m;
  };
  for (const auto& [radius_m, dash_m, gap_m] : {Row{40, 3, 9}, Row{100, 6, 12}, Row{250, 6, 12}})
    for (const double next_m : {3.0, 3.5}) {
      SCOPED_TRACE(radius_m);
      std::vector<ObservedMarking> dashes;
      for (const double r : {radius_m, radius_m + next_m})
        for (int i = 0; i < 4; ++i) {
          const double degrees_per_m = 180.0 / (std::numbers::pi * r), from_m = i * (dash_m + gap_m);
          dashes.push_back(piece({0, 0, 0}, {1, 0, 0}));
          dashes.back().points =
              test::arc({0, 0, 0}, r, from_m * degrees_per_m, (from_m + dash_m) * degrees_per_m);
        }
      const auto lines = join_dashes(dashes);
      ASSERT_EQ(lines.size(), 2U);
      for (const ObservedMarking& line : lines)
        EXPECT_NEAR((line.points.front() - line.points.back()).norm(),
                    2.0 * line.points.front().norm() *
                        std::sin(0.5 * (4.0 * dash_m + 3.0 * gap_m) / line.points.front().norm()),
                    0.01);
    }
}

TEST(JoinDashes, ARowHasTheNumberOfItsFirstDash) {
  std::vector<ObservedMarking> dashes = row(1.8, 3);
  for (std::size_t i = 0; i < dashes.size(); ++i) dashes[i].number = 4 + i;
  const auto lines = join_dashes(std::move(dashes));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].number, 4U);
}

TEST(JoinDashes, ARowHasTheMeanConfidenceOfItsDashes) {
  auto dashes = row(1.8, 2);
  dashes[0].confidence = 0.4;
  const auto lines = join_dashes(dashes);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_DOUBLE_EQ(lines[0].confidence, 0.6);
}

TEST(JoinDashes, TheOrderAndTheDirectionOfTheDashesDoNotMatter) {
  auto dashes = row(0, 4);
  std::ranges::reverse(dashes[2].points);
  dashes[1].stddev_m.assign(dashes[1].points.size(), 0.1);
  std::swap(dashes[0], dashes[3]);
  const auto lines = join_dashes(dashes);
  ASSERT_EQ(lines.size(), 1U);
  for (std::size_t i = 1; i < lines[0].points.size(); ++i)
    EXPECT_GE(lines[0].points[i].x(), lines[0].points[i - 1].x()) << i;  // as the first one of them runs
  EXPECT_TRUE(lines[0].stddev_m.empty()) << "three of the four have none";
}

TEST(JoinDashes, KeepsTheRowsOfNeighbouringLanesApart) {
  auto dashes = row(1.8, 3);
  for (const auto& dash : row(-1.8, 3)) dashes.push_back(dash);
  const auto lines = join_dashes(dashes);
  ASSERT_EQ(lines.size(), 2U);
  for (const auto& line : lines)
    for (const Point& point : line.points) EXPECT_EQ(point.y(), line.points.front().y());
}

TEST(JoinDashes, ALineThatIsCutGoesOnWithItsPiece) {
  const auto lines = join_dashes({piece({0, 0, 0}, {30, 0, 0}), piece({33, 0, 0}, {38, 0, 0})});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].style, MarkingStyle::unknown) << "two pieces may be of a solid line";
}

TEST(JoinDashes, LeavesWhatIsNoRow) {
  const auto long_lines = join_dashes({piece({0, 0, 0}, {15, 0, 0}), piece({18, 0, 0}, {33, 0, 0})});
  EXPECT_EQ(long_lines.size(), 2U);
  const auto too_far = join_dashes({piece({0, 0, 0}, {3, 0, 0}), piece({17, 0, 0}, {20, 0, 0})});
  EXPECT_EQ(too_far.size(), 2U);
  const auto beside = join_dashes({piece({0, 0, 0}, {3, 0, 0}), piece({6, 1, 0}, {9, 1, 0})});
  EXPECT_EQ(beside.size(), 2U);
  const auto tip = join_dashes({piece({0, 0, 0}, {8, 0, 0}), piece({8, 0, 0}, {2, 3, 0})});
  EXPECT_EQ(tip.size(), 2U) << "the ends meet, and the lines part";
  const auto above = join_dashes({piece({0, 0, 0}, {3, 0, 0}), piece({6, 0, 5}, {9, 0, 5})});
  EXPECT_EQ(above.size(), 2U);
}

TEST(JoinDashes, LeavesSolidLinesAndOtherTypes) {
  auto dashes = row(0, 3);
  dashes[0].style = MarkingStyle::solid;
  dashes[1].type = MarkingType::roadedge;
  dashes[2].type = MarkingType::stopline;
  const auto lines = join_dashes(dashes);
  ASSERT_EQ(lines.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(lines[i].type, dashes[i].type);
    EXPECT_EQ(lines[i].points, dashes[i].points);
    EXPECT_EQ(lines[i].confidence, dashes[i].confidence);
  }
}

TEST(JoinDashes, ARingOfDashesIsNotClosed) {
  std::vector<ObservedMarking> ring;
  for (int i = 0; i < 48; ++i) {
    const auto at = [](double angle) { return Point(60 * std::cos(angle), 60 * std::sin(angle), 0); };
    const double angle = 2 * std::numbers::pi * i / 48;
    ring.push_back(piece(at(angle), at(angle + 0.06)));
  }
  const auto lines = join_dashes(ring);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_GT((lines[0].points.front() - lines[0].points.back()).norm(), 3.0);
}

}  // namespace
}  // namespace laneloom::markings
