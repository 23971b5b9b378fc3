#include "simulation/borders.hpp"

#include <gtest/gtest.h>

#include "laneloom/polyline.hpp"
#include "simulation/drivable_areas.hpp"

namespace laneloom::simulation {
namespace {

RoadMarking line(ElementId id, const Polyline& points, MarkingStyle style = MarkingStyle::solid) {
  return {id, MarkingType::laneline, style, points};
}

TEST(JoinMarkings, JoinsWhatContinuesWhicheverWayItIsDrawn) {
  Road road;
  road.markings = {line(5, {{10.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}),
                   line(7, {{20.0, 0.0, 0.0}, {10.0, 0.0, 0.0}}),
                   line(9, {{30.0, 0.0, 0.0}, {20.0, 0.0, 0.0}}, MarkingStyle::dashed)};
  road.lanes.resize(1);
  road.lanes[0].left_marking = 7;
  road.lanes[0].right_marking = 9;
  join_markings(road, 0.1);
  ASSERT_EQ(road.markings.size(), 2u);
  EXPECT_EQ(road.markings[0].points, (Polyline{{20.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}));
  EXPECT_EQ(road.lanes[0].left_marking, 1u);
  EXPECT_EQ(road.lanes[0].right_marking, 2u);
}

TEST(JoinMarkings, LeavesForksAndCornersAlone) {
  Road road;
  road.markings = {
      line(1, {{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}}), line(2, {{10.0, 0.0, 0.0}, {20.0, 0.0, 0.0}}),
      line(3, {{10.0, 0.0, 0.0}, {20.0, 1.0, 0.0}}), line(4, {{20.0, 1.0, 0.0}, {20.0, 9.0, 0.0}})};
  join_markings(road, 0.1);
  EXPECT_EQ(road.markings.size(), 4u);
}

TEST(JoinMarkings, ClosesARing) {
  Road road;
  Polyline half, other;
  for (int i = 0; i <= 18; ++i) {
    const Eigen::AngleAxisd turn(i * 3.14159265358979 / 18.0, Point::UnitZ());
    half.push_back(turn * Point(10.0, 0.0, 0.0));
    other.push_back(turn * Point(-10.0, 0.0, 0.0));
  }
  road.markings = {line(1, half), line(2, other)};
  join_markings(road, 0.01);
  ASSERT_EQ(road.markings.size(), 1u);
  EXPECT_EQ(road.markings[0].points.front(), road.markings[0].points.back());
  EXPECT_EQ(road.markings[0].points.size(), 37u);
}

TEST(AttachRoadedges, GivesTheEdgeToTheBorderThatRunsAlongIt) {
  Road road;
  road.markings = {{3, MarkingType::roadedge, MarkingStyle::solid, {{-50.0, -3.5, 0.0}, {50.0, -3.5, 0.0}}}};
  road.lanes.resize(1);
  road.lanes[0].left = {{0.0, 0.0, 0.0}, {20.0, 0.0, 0.0}};
  road.lanes[0].right = {{0.0, -3.3, 0.0}, {20.0, -3.3, 0.0}};
  attach_markings(road, MarkingType::roadedge, 0.5);
  EXPECT_EQ(road.lanes[0].left_marking, kNoElement);
  EXPECT_EQ(road.lanes[0].right_marking, 3u);
}

TEST(OuterEdges, TheCommonBorderOfTouchingAreasIsNone) {
  const Polyline west{{0.0, 0.0, 0.0}, {20.0, 0.0, 0.0}, {20.0, 10.0, 0.0}, {0.0, 10.0, 0.0}};
  const Polyline east{{20.0, 0.0, 0.0}, {40.0, 0.0, 0.0}, {40.0, 10.0, 0.0}, {20.0, 10.0, 0.0}};
  double total_m = 0.0;
  for (const Polyline& edge : outer_edges({west, east})) {
    total_m += length(edge);
    for (const Point& p : edge) EXPECT_FALSE(std::abs(p.x() - 20.0) < 0.2 && p.y() > 1.0 && p.y() < 9.0);
  }
  EXPECT_NEAR(total_m, 100.0, 4.0);
}

TEST(OuterEdges, ALoneAreaIsARing) {
  const auto edges = outer_edges({{{0.0, 0.0, 0.0}, {20.0, 0.0, 0.0}, {20.0, 10.0, 0.0}}});
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_EQ(edges[0].front(), edges[0].back());
  EXPECT_EQ(edges[0].size(), 4u);
}

}  // namespace
}  // namespace laneloom::simulation
