#include "mapping/lanes/road_cuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

/// Boundaries side by side, the first one on the right.
boundaries::SectionGraph side_by_side(int count, double apart_m) {
  std::vector<boundaries::LaneBoundary> all;
  for (int i = 0; i < count; ++i) {
    const double y = apart_m * i;
    all.push_back(test::boundary(static_cast<ElementId>(i + 1), test::straight({0, y, 0}, {20, y, 0}, 21)));
    all.back().course = MeasuredPolyline(all.back().marking.points);
  }
  boundaries::Boundaries boundaries;
  boundaries.insert(std::move(all));
  return boundaries::road_sections(std::move(boundaries), test::at(5), SectionConfig{});
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
