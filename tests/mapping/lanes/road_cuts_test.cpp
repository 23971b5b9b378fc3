#include "mapping/lanes/road_cuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

boundaries::SectionGraph road_of(const std::vector<Polyline>& lines) {
  std::vector<boundaries::LaneBoundary> all;
  for (const Polyline& line : lines) {
    all.push_back(test::boundary(all.size() + 1, line));
    all.back().course = MeasuredPolyline(line);
  }
  boundaries::Boundaries boundaries;
  boundaries.insert(std::move(all));
  return boundaries::road_sections(std::move(boundaries), test::at(5), SectionConfig{});
}

/// Boundaries side by side, the first one on the right.
boundaries::SectionGraph side_by_side(int count, double apart_m) {
  std::vector<Polyline> lines;
  for (int i = 0; i < count; ++i)
    lines.push_back(test::straight({0, apart_m * i, 0}, {20, apart_m * i, 0}, 21));
  return road_of(lines);
}

/// How many cross-sections along the first boundary meet the second one.
int meeting(const RoadCuts& cuts) {
  int count = 0;
  for (std::size_t i = 0; i < cuts.size(); ++i) count += cuts[i].marks.size() > 1 ? 1 : 0;
  return count;
}

TEST(RoadCuts, ShowWhatLiesBesideFromRightToLeft) {
  const RoadCuts cuts = cut_along(1, side_by_side(3, 3.5), LaneConfig{});
  ASSERT_EQ(cuts.size(), 21U);
  const RoadCut cut = cuts[10];
  ASSERT_EQ(cut.marks.size(), 3U);
  EXPECT_EQ(cut.own, 1U);
  EXPECT_NEAR(cut.marks[0].lateral_m, -3.5, 1e-9);
  EXPECT_NEAR(cut.marks[2].lateral_m, 3.5, 1e-9);
  EXPECT_FALSE(cuts.has_opposed());
}

TEST(RoadCuts, ShowABoundaryThatEndsJustBefore) {
  for (const double end_x : {15.4, 15.6}) {
    const auto road =
        road_of({test::straight({0, 0, 0}, {20, 0, 0}, 21), test::straight({0, 3.5, 0}, {end_x, 3.5, 0})});
    const RoadCuts cuts = cut_along(0, road, LaneConfig{});
    EXPECT_EQ(meeting(cuts), end_x < 15.5 ? 16 : 17);
    const RoadCut last = cuts[end_x < 15.5 ? 15 : 16];
    ASSERT_EQ(last.marks.size(), 2U);
    EXPECT_TRUE(last.marks[1].point.isApprox(Point(end_x < 15.5 ? 15 : 16, 3.5, 0)));
    EXPECT_NEAR(last.marks[1].lateral_m, 3.5, 1e-9);
  }
}

/// On a cross-section that is turned, what is near the end of a boundary along the boundary may be far from
/// it.
TEST(RoadCuts, DoNotProlongABoundaryBesideOneThatTurnsAway) {
  Polyline corner = test::straight({0, 0, 0}, {10, 0, 0}, 11);
  const Polyline turn = test::arc({10, -8, 0}, 8.0, 90.0, 0.0);
  corner.insert(corner.end(), turn.begin() + 1, turn.end());
  const RoadCuts cuts =
      cut_along(0, road_of({corner, test::straight({0, 3.5, 0}, {14, 3.5, 0}, 15)}), LaneConfig{});
  for (std::size_t i = 0; i < cuts.size(); ++i)
    for (const Mark& mark : cuts[i].marks) EXPECT_TRUE(mark.boundary == 0 || mark.point.x() < 14.5) << i;
}

TEST(RoadCuts, TurnedRoundRunTheOtherWay) {
  const RoadCuts cuts = cut_along(0, side_by_side(2, 3.5), LaneConfig{}), turned = cuts.reversed();
  ASSERT_EQ(turned.size(), cuts.size());
  const RoadCut first = turned[0];
  EXPECT_EQ(first.own, 1U);
  EXPECT_EQ(first.self().arc_m, 20.0);
  EXPECT_NEAR(first.marks[0].lateral_m, -3.5, 1e-9);
  EXPECT_TRUE(first.marks[0].opposed);
  EXPECT_TRUE(turned.has_opposed());
}

TEST(RoadCuts, OfACrowdShowTheNearest) {
  const RoadCuts cuts = cut_along(20, side_by_side(41, 0.3), LaneConfig{});
  const RoadCut cut = cuts[10];
  EXPECT_EQ(cut.marks.size(), 13U);
  EXPECT_NEAR(cut.marks.front().lateral_m, -1.8, 1e-6);
  EXPECT_NEAR(cut.marks.back().lateral_m, 1.8, 1e-6);
}

}  // namespace
}  // namespace laneloom::lanes
