#include "mapping/lanes/paper_lanes.hpp"

#include <gmock/gmock.h>

#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/lanes/lane_tracks.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using test::boundary;
using test::straight;

/// Lanes of boundaries that run forward, with ids and neighbours.
std::vector<Lane> lanes_of(std::vector<boundaries::LaneBoundary> boundaries) {
  boundaries::SectionGraph graph = road_sections(std::move(boundaries), test::at(0), {});
  markings::IdSource ids(100);
  return LaneTracks().adopt(laid_out(paper_lanes(std::move(graph), {})), ids).lanes;
}

const Lane* between(const std::vector<Lane>& lanes, ElementId left, ElementId right) {
  const auto found = std::ranges::find_if(lanes, [&](const Lane& l) {
    return l.left_borders.front().boundary == left && l.right_borders.front().boundary == right;
  });
  return found == lanes.end() ? nullptr : &*found;
}

TEST(PaperLanes, BetweenTwoBoundaries) {
  const auto lanes = lanes_of(
      {boundary(1, straight({0, 3.5, 0}, {30, 3.5, 0})), boundary(2, straight({0, 0, 0}, {30, 0, 0}))});
  ASSERT_EQ(lanes.size(), 1U);
  const Lane& lane = lanes[0];
  EXPECT_EQ(lane.left_borders.front().boundary, 1U);
  EXPECT_EQ(lane.right_borders.front().boundary, 2U);
  EXPECT_NEAR(lane.width_m, 3.5, 1e-9);
  EXPECT_NEAR(lane.left_borders.front().on_boundary.length(), 30.0, 1e-9);
  EXPECT_NEAR(lane.right_borders.front().on_boundary.length(), 30.0, 1e-9);
  for (const Point& p : lane.centerline) EXPECT_NEAR(p.y(), 1.75, 1e-9);
  EXPECT_NEAR(length(lane.centerline), 30.0, 1e-9);
  EXPECT_TRUE(lane.left_neighbours.empty());
}

TEST(PaperLanes, NeighboursAreAcrossASharedBoundary) {
  const auto lanes = lanes_of({boundary(1, straight({0, 7, 0}, {30, 7, 0})),
                               boundary(2, straight({0, 3.5, 0}, {30, 3.5, 0})),
                               boundary(3, straight({0, 0, 0}, {30, 0, 0}))});
  ASSERT_EQ(lanes.size(), 2U);
  const Lane* left = between(lanes, 1, 2);
  const Lane* right = between(lanes, 2, 3);
  ASSERT_TRUE(left && right);
  EXPECT_EQ(main_neighbour(*left, Side::right), right->id);
  EXPECT_EQ(main_neighbour(*right, Side::left), left->id);
  EXPECT_TRUE(left->left_neighbours.empty());
  EXPECT_EQ(left->section, right->section);
}

/// Edges of a road along x, with a lane on either side of its centre line, and of one that joins it from the
/// right. Round its corners no sense of direction fits all.
std::vector<boundaries::LaneBoundary> t_junction() {
  const auto joined = [](Polyline a, const Polyline& b, const Polyline& c) {
    a.insert(a.end(), b.begin(), b.end());
    a.insert(a.end(), c.begin(), c.end());
    return a;
  };
  const Polyline west = joined(straight({-30, -3.5, 0}, {13, -3.5, 0}), test::arc({13.5, -6.5, 0}, 3, 90, 0),
                               straight({16.5, -7, 0}, {16.5, -30, 0}));
  const Polyline east =
      joined(straight({23.5, -30, 0}, {23.5, -7, 0}), test::arc({26.5, -6.5, 0}, 3, 180, 90),
             straight({27, -3.5, 0}, {60, -3.5, 0}));
  return {boundary(1, straight({-30, 3.5, 0}, {60, 3.5, 0}), MarkingType::roadedge),
          boundary(2, straight({-30, 0, 0}, {12, 0, 0})),
          boundary(3, straight({28, 0, 0}, {60, 0, 0})),
          boundary(4, west, MarkingType::roadedge),
          boundary(5, east, MarkingType::roadedge),
          boundary(6, straight({20, -30, 0}, {20, -8, 0}))};
}

TEST(PaperLanes, RoundTheCornersOfAJunctionNoneIsLost) {
  const auto lanes = lanes_of(t_junction());
  ASSERT_EQ(lanes.size(), 6U);
  for (const Lane& lane : lanes) {
    EXPECT_NEAR(lane.width_m, 3.5, 0.05);
    EXPECT_GT(length(lane.centerline), 20.0);
    EXPECT_LT(MeasuredPolyline(lane.left).project(lane.right[1]).lateral_m, 0.0);
    // Each has the other one of its road across the centre line.
    EXPECT_NE(lane.left_neighbours.empty(), lane.right_neighbours.empty());
    for (const auto& [id, range] :
         {std::pair(lane.left_borders.front().boundary, lane.left_borders.front().on_boundary),
          std::pair(lane.right_borders.front().boundary, lane.right_borders.front().on_boundary)}) {
      EXPECT_LT(range.from_m, range.to_m);
      const auto boundaries = t_junction();
      const double end_m = length(std::ranges::find(boundaries, id, [](const boundaries::LaneBoundary& b) {
                                    return b.marking.id;
                                  })->marking.points);
      EXPECT_GE(range.from_m, 0.0);
      EXPECT_LE(range.to_m, end_m + 1e-9);
    }
  }
}

TEST(PaperLanes, ALaneBesideAReversedBoundaryLiesWhereItSays) {
  // Both boundaries have the other on their left, whatever way they run.
  const boundaries::SectionGraph graph{
      .boundaries = std::vector{boundary(1, straight({0, 0, 0}, {30, 0, 0})),
                                boundary(2, straight({40, 3.5, 0}, {0, 3.5, 0}))},
      .sections = {{{0, 1}}},
      .beside = {{{1, 3.5, 30.0, true}}, {{0, 3.5, 30.0, true}}}};
  const auto lanes = paper_lanes(graph, {}).lanes;
  ASSERT_EQ(lanes.size(), 1U);
  EXPECT_EQ(lanes[0].right_borders.front().boundary, 1U);
  EXPECT_EQ(lanes[0].left_borders.front().boundary, 2U);
  EXPECT_TRUE(lanes[0].left_borders.front().reversed);
  EXPECT_FALSE(lanes[0].right_borders.front().reversed);
  EXPECT_NEAR(lanes[0].left_borders.front().on_boundary.from_m, 10.0, 1e-9);
  EXPECT_NEAR(lanes[0].left_borders.front().on_boundary.to_m, 40.0, 1e-9);
  EXPECT_NEAR(lanes[0].right_borders.front().on_boundary.from_m, 0.0, 1e-9);
  EXPECT_TRUE(lanes[0].centerline.front().isApprox(Point(0, 1.75, 0)));
}

TEST(PaperLanes, SayWhereTheyWereInferredAcrossAGap) {
  auto left = boundary(1, straight({0, 3.5, 0}, {30, 3.5, 0}));
  left.bridged = {{10, 14}};
  const auto lanes = lanes_of({left, boundary(2, straight({0, 0, 0}, {30, 0, 0}))});
  ASSERT_EQ(lanes.size(), 1U);
  ASSERT_EQ(lanes[0].inferred_ranges.size(), 1U);
  EXPECT_NEAR(lanes[0].inferred_ranges[0].from_m, 10.0, 1.0);
  EXPECT_NEAR(lanes[0].inferred_ranges[0].to_m, 14.0, 1.0);
}

TEST(PaperLanes, AreAsSureAsTheLessSureOfTheirBoundaries) {
  auto left = boundary(1, straight({0, 3.5, 0}, {30, 3.5, 0}));
  auto right = boundary(2, straight({0, 0, 0}, {30, 0, 0}));
  left.marking.existence_probability = 0.9;
  right.marking.existence_probability = 0.6;
  right.marking.status = ElementStatus::tentative;
  const auto lanes = lanes_of({left, right});
  ASSERT_EQ(lanes.size(), 1U);
  EXPECT_EQ(lanes[0].existence_probability, 0.6);
  EXPECT_EQ(lanes[0].status, ElementStatus::tentative);
}

class Width : public ::testing::TestWithParam<std::pair<double, bool>> {};

TEST_P(Width, MustLieInTheInterval) {
  const auto [width_m, is_lane] = GetParam();
  const auto lanes = lanes_of({boundary(1, straight({0, width_m, 0}, {30, width_m, 0})),
                               boundary(2, straight({0, 0, 0}, {30, 0, 0}))});
  EXPECT_EQ(lanes.size(), is_lane ? 1U : 0U);
}

INSTANTIATE_TEST_SUITE_P(Interval, Width,
                         ::testing::Values(std::pair(2.0, false), std::pair(2.4, true), std::pair(4.4, true),
                                           std::pair(4.6, false)));

// Paper, Fig. 5 (c): the valid range is where the distance is steady and in the interval.
TEST(PaperLanes, EndWhereTheRoadWidens) {
  const auto lanes = lanes_of(
      {boundary(1, straight({0, 3.5, 0}, {40, 3.5, 0})), boundary(2, {{0, 0, 0}, {20, 0, 0}, {40, -10, 0}})});
  ASSERT_GE(lanes.size(), 1U);
  const Lane& lane = lanes[0];
  EXPECT_NEAR(lane.right_borders.front().on_boundary.from_m, 0.0, 1e-9);
  EXPECT_GT(lane.left_borders.front().on_boundary.to_m, 20.0);
  EXPECT_LT(lane.left_borders.front().on_boundary.to_m, 22.5);  // 0.8 m wider than at its narrowest
}

// Paper, Fig. 5 (d): one lane becomes two, by (b_i, b_i+1) and (b_i, b_i+2).
TEST(PaperLanes, ASplitGivesThreeLanes) {
  const auto lanes = lanes_of({boundary(1, straight({0, 3.5, 0}, {60, 3.5, 0})),
                               boundary(2, straight({24, 0, 0}, {60, 0, 0})),  // begins at the taper
                               boundary(3, {{0, 0, 0}, {20, 0, 0}, {30, -3.5, 0}, {60, -3.5, 0}})});
  const Lane* before = between(lanes, 1, 3);
  const Lane* left = between(lanes, 1, 2);
  const Lane* right = between(lanes, 2, 3);
  ASSERT_TRUE(before && left && right);
  EXPECT_NEAR(before->left_borders.front().on_boundary.to_m, 22.0, 1.5);
  EXPECT_NEAR(left->left_borders.front().on_boundary.from_m, 24.0, 0.6);
  EXPECT_GT(right->left_borders.front().on_boundary.from_m, 0.0);
  EXPECT_NEAR(left->left_borders.front().on_boundary.to_m, 60.0, 1e-9);
}

TEST(PaperLanes, AMergeGivesTheSameLanesMirrored) {
  const auto lanes = lanes_of({boundary(1, straight({0, 3.5, 0}, {60, 3.5, 0})),
                               boundary(2, straight({0, 0, 0}, {36, 0, 0})),
                               boundary(3, {{0, -3.5, 0}, {30, -3.5, 0}, {40, 0, 0}, {60, 0, 0}})});
  EXPECT_TRUE(between(lanes, 1, 2) && between(lanes, 2, 3) && between(lanes, 1, 3));
}

TEST(PaperLanes, DoNotOverlapWhereANarrowStripRunsBeside) {
  // A cycle strip of 1.2 m: the lane is to its near side, not across it, though both widths are allowed.
  const auto lanes =
      lanes_of({boundary(1, straight({0, 3, 0}, {30, 3, 0})), boundary(2, straight({0, 0, 0}, {30, 0, 0})),
                boundary(3, straight({0, -1.2, 0}, {30, -1.2, 0}))});
  ASSERT_EQ(lanes.size(), 1U);
  EXPECT_EQ(lanes[0].right_borders.front().boundary, 2U);
}

TEST(PaperLanes, GoOnWhereADoubleLineEndsAndOneLineBeginsBesideIt) {
  // Both halves of the double line lie between the left edge of the road and the line, but for a metre only.
  const auto lanes = lanes_of(
      {boundary(1, straight({0, 3.5, 0}, {60, 3.5, 0})), boundary(2, straight({0, 0.2, 0}, {21, 0.2, 0})),
       boundary(3, straight({0, 0.1, 0}, {21, 0.1, 0})), boundary(4, straight({20, 0, 0}, {60, 0, 0}))});
  const Lane* after = between(lanes, 1, 4);
  ASSERT_TRUE(after);
  EXPECT_GT(after->left_borders.front().on_boundary.length(), 35.0);
}

TEST(PaperLanes, InABendOfTwelveMetres) {
  const auto lanes = lanes_of(
      {boundary(1, test::arc({0, 0, 0}, 10.25, -90, 0)), boundary(2, test::arc({0, 0, 0}, 13.75, -90, 0))});
  ASSERT_EQ(lanes.size(), 1U);
  EXPECT_NEAR(lanes[0].width_m, 3.5, 0.02);
  EXPECT_LT(test::max_distance(lanes[0].centerline, test::arc({0, 0, 0}, 12, -90, 0)), 0.05);
}

}  // namespace
}  // namespace laneloom::lanes
