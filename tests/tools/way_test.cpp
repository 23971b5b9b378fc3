#include "evaluation/way.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace laneloom::evaluation {
namespace {

Lane lane(ElementId id, const Polyline& centerline) {
  return {.id = id, .centerline = centerline, .width_m = 3.5};
}

/// A lane along x.
Lane straight(ElementId id, double y_m, double from_m = -50.0, double to_m = 150.0) {
  return lane(id, {{from_m, y_m, 0}, {to_m, y_m, 0}});
}

TEST(Way, TakesTheLinkageThatLeadsStraightest) {
  const LocalMap map{.lanes = {straight(1, 0, -50, 10), lane(2, {{10, 0, 0}, {20, 10, 0}}),
                               straight(3, 0, 10, 20), lane(4, {{10, 0, 0}, {20, -2, 0}})},
                     .linkages = {{.from = 1, .to = 2}, {.from = 1, .to = 3}, {.from = 1, .to = 4}}};
  EXPECT_TRUE(way_ahead(map, map.T_map_body).points.back().isApprox(Point(20, 0, 0)));
}

TEST(Way, GoesRoundARingOnce) {
  const LocalMap map{.lanes = {straight(1, 0, -5, 5), straight(2, 0, 5, -5)},
                     .linkages = {{.from = 1, .to = 2}, {.from = 2, .to = 1}}};
  EXPECT_EQ(way_ahead(map, map.T_map_body, 1e9).joints.size(), 2u);
}

TEST(Way, OfALaneInTheOppositeSenseEndsAtItsFirstPoint) {
  const LocalMap map{.lanes = {straight(1, 0, 10, -50), straight(2, 0, -50, -90)},
                     .linkages = {{.from = 1, .to = 2}}};
  const Way way = way_ahead(map, map.T_map_body);
  EXPECT_NEAR(length(way.points), 10.0, 1e-9);
  EXPECT_TRUE(way.points.back().isApprox(Point(10, 0, 0)));
  EXPECT_EQ(way.lane, 1u);
}

TEST(Way, OfOverlappingLanesTheNearestIsTheOwn) {
  const LocalMap map{.lanes = {straight(1, 1.0), straight(2, -0.5), straight(3, 1.5)}};
  EXPECT_EQ(way_ahead(map, map.T_map_body).lane, 2u);
}

TEST(Way, AKinkIsTheTurnWithin4M) {
  EXPECT_NEAR(largest_kink_deg({{0, 0, 0}, {30, 0, 0}}), 0.0, 1e-9);
  EXPECT_NEAR(largest_kink_deg({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}}), 90.0, 1e-9);
  EXPECT_NEAR(largest_kink_deg({{0, 0, 0}, {10, 0, 0}, {20, 10 * std::tan(0.1), 0}}), 0.1 * 57.29578, 1e-3);
  EXPECT_EQ(largest_kink_deg({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}), 0.0) << "too short to tell";
  EXPECT_EQ(largest_kink_deg({}), 0.0);
}

}  // namespace
}  // namespace laneloom::evaluation
