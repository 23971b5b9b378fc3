#include "evaluation/lane_metres.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace laneloom::evaluation {
namespace {

Polyline along_x(double y_m) { return {{-50, y_m, 0}, {50, y_m, 0}}; }

/// Lane 1 leads east below the line y = 0, lane 2 west above it. Edges at 4.5 m leave strips of 1 m.
simulation::Road two_lanes() {
  simulation::Road road;
  road.lanes = {{.id = 1, .left = along_x(0), .right = along_x(-3.5), .centerline = along_x(-1.75)},
                {.id = 2,
                 .left = {{50, 0, 0}, {-50, 0, 0}},
                 .right = {{50, 3.5, 0}, {-50, 3.5, 0}},
                 .centerline = {{50, 1.75, 0}, {-50, 1.75, 0}}}};
  road.markings = {{.id = 1, .type = MarkingType::laneline, .points = along_x(0)},
                   {.id = 2, .type = MarkingType::roadedge, .points = along_x(4.5)},
                   {.id = 3, .type = MarkingType::roadedge, .points = along_x(-4.5)},
                   {.id = 4, .type = MarkingType::stopline, .points = {{0, 9, 0}, {0, 11, 0}}}};
  return road;
}

/// 20 m within the range, and more beyond it.
LaneMetres metres_of(double y_m, Lane::Direction direction = Lane::Direction::unknown,
                     Lane::Use use = Lane::Use::lane) {
  LaneMetresMeter meter(two_lanes(), {.forward_min_m = 0, .forward_max_m = 20, .side_max_m = 30});
  meter.add({.lanes = {{.id = 1, .centerline = along_x(y_m), .direction = direction, .use = use}}});
  return meter.metres();
}

double share(double y_m, LaneClass lane_class) {
  const LaneMetres metres = metres_of(y_m);
  return metres.of(lane_class) / metres.published_m();
}

TEST(LaneMetres, AreOfOneClassEach) {
  EXPECT_NEAR(metres_of(-1.75).published_m(), 20.0, 0.5);
  EXPECT_EQ(share(-1.75, LaneClass::right), 1.0);
  EXPECT_EQ(share(2.2, LaneClass::right), 1.0);
  EXPECT_EQ(share(0.3, LaneClass::straddling), 1.0);
  EXPECT_EQ(share(1.1, LaneClass::offset), 1.0);
  EXPECT_EQ(share(2.9, LaneClass::offset), 1.0);
  EXPECT_EQ(share(4.0, LaneClass::beside_edge), 1.0) << "on the strip";
  EXPECT_EQ(share(6.0, LaneClass::beside_edge), 1.0) << "beyond";
  EXPECT_EQ(share(10.0, LaneClass::elsewhere), 1.0) << "a stopline is no line along the road";
}

TEST(LaneMetres, OfALaneOnABridgeAreNotThoseBelow) {
  LaneMetresMeter meter(two_lanes(), {.forward_min_m = 0, .forward_max_m = 20, .side_max_m = 30});
  meter.add({.lanes = {{.id = 1, .centerline = {{-50, -1.75, 2.5}, {50, -1.75, 2.5}}}}});
  EXPECT_EQ(meter.metres().of(LaneClass::right), 0.0);
  EXPECT_GT(meter.metres().of(LaneClass::elsewhere), 19.0);
}

TEST(LaneMetres, OfATruthWithoutBordersAreRightOrElsewhere) {
  simulation::Road road;
  road.lanes = {{.id = 1, .centerline = along_x(0)}};
  LaneMetresMeter meter(road, {.forward_min_m = 0, .forward_max_m = 20, .side_max_m = 30});
  meter.add({.lanes = {{.id = 1, .centerline = along_x(0.2)}, {.id = 2, .centerline = along_x(1.0)}}});
  EXPECT_EQ(meter.metres().of(LaneClass::right), meter.metres().of(LaneClass::elsewhere));
  EXPECT_GT(meter.metres().of(LaneClass::right), 19.0);
}

TEST(LaneMetres, ShouldersAreApart) {
  const auto shoulder_at = [](double y_m) {
    return metres_of(y_m, Lane::Direction::unknown, Lane::Use::shoulder);
  };
  const LaneMetres beside = shoulder_at(4.0), within = shoulder_at(2.2);
  EXPECT_EQ(beside.published_m(), 0.0);
  EXPECT_NEAR(beside.shoulder_m, 20.0, 0.5);
  EXPECT_EQ(beside.shoulder_outside_m, beside.shoulder_m);
  EXPECT_NEAR(within.shoulder_m, 20.0, 0.5);
  EXPECT_EQ(within.shoulder_outside_m, 0.0);
}

TEST(LaneMetres, DirectionsAreRatedWhereTheLaneIsRight) {
  const auto told = [](double y_m, Lane::Direction direction) {
    const LaneMetres metres = metres_of(y_m, direction);
    return std::pair(metres.told_m, metres.told_right_m);
  };
  const double all_m = metres_of(-1.75).published_m();
  EXPECT_EQ(told(-1.75, Lane::Direction::along_centerline), std::pair(all_m, all_m));
  EXPECT_EQ(told(-1.75, Lane::Direction::against_centerline), std::pair(all_m, 0.0));
  EXPECT_EQ(told(1.75, Lane::Direction::along_centerline), std::pair(all_m, 0.0));
  EXPECT_EQ(told(1.75, Lane::Direction::both), std::pair(all_m, all_m));
  EXPECT_EQ(told(1.75, Lane::Direction::unknown), std::pair(0.0, 0.0));
  EXPECT_EQ(told(10.0, Lane::Direction::along_centerline), std::pair(0.0, 0.0));
}

TEST(LaneMetres, AreSummed) {
  LaneMetres sum = metres_of(-1.75, Lane::Direction::along_centerline);
  const double all_m = sum.published_m();
  sum += metres_of(0.3, Lane::Direction::along_centerline);
  EXPECT_EQ(sum.published_m(), 2.0 * all_m);
  EXPECT_EQ(sum.of(LaneClass::straddling), all_m);
  EXPECT_EQ(sum.told_right_m, all_m);
}

LaneMetres driven(double y_m, bool east) {
  Polyline points = along_x(y_m);
  if (!east) std::ranges::reverse(points);
  LaneMetresMeter meter(two_lanes(), {.forward_min_m = 0, .forward_max_m = 20, .side_max_m = 30});
  meter.add({.driven_paths = {{.id = 1, .points = points, .probability = 0.8}}});
  return meter.metres();
}

TEST(DrivenMetres, AreNearALaneWhoseTrafficRunsThatWay) {
  const LaneMetres there = driven(-1.0, true);
  EXPECT_NEAR(there.driven_m, 20.0, 0.5);
  EXPECT_EQ(there.driven_near_m, there.driven_m);
  EXPECT_NEAR(there.driven_belief_m, 0.8 * there.driven_m, 1e-9);
  EXPECT_EQ(driven(-0.5, true).driven_near_m, 0.0);
  EXPECT_EQ(driven(-0.5, true).driven_there_m, there.driven_m);
  EXPECT_EQ(driven(-4.0, true).driven_there_m, 0.0);
  EXPECT_EQ(driven(-1.0, false).driven_there_m, 0.0) << "against the traffic";
  EXPECT_EQ(there.published_m(), 0.0) << "no lane";
}

}  // namespace
}  // namespace laneloom::evaluation
