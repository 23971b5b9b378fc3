#include "drive/path_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drive/steering.hpp"
#include "maps.hpp"

namespace laneloom::drive {
namespace {

Plan plan_on(const LocalMap& map, const Bicycle& vehicle, const Plan& previous = {},
             WayWish wish = WayWish::straight) {
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  T_map_body.translation() = on_ground(vehicle.rear_axle);
  T_map_body.rotate(Eigen::AngleAxisd(vehicle.heading_rad, Eigen::Vector3d::UnitZ()));
  return next_plan(map, T_map_body, vehicle.speed_mps, previous, {.wish = wish});
}

double distance(const Plan& plan, const Point& point) {
  return MeasuredPolyline(plan.path).project(point).distance_m;
}

TEST(Planner, FollowsAStraightLane) {
  LocalMap map;
  map.lanes = {lane_of(1, straight_line({-20, 0, 0}, {100, 0, 0}))};
  const Bicycle vehicle{.rear_axle = {0.0, 0.5}, .speed_mps = 5.0};
  const Plan first = plan_on(map, vehicle);
  EXPECT_LT(distance(first, {0, 0.5, 0}), 0.01);   // from where it is
  EXPECT_LT(distance(first, {20, 0.0, 0}), 0.01);  // into the middle
  EXPECT_EQ(first.support_at({1, 0.5, 0}), Support::mapped);
  EXPECT_EQ(first.support_at({30, 0, 0}), Support::mapped);
  EXPECT_EQ(first.support.size(), first.path.size());
}

TEST(Planner, FollowsABendThroughASuccessor) {
  const Polyline arc = left_arc(15.0, 2.0);
  LocalMap map;
  map.lanes = {lane_of(1, {arc.begin(), arc.begin() + 15}), lane_of(2, {arc.begin() + 14, arc.end()})};
  map.linkages = {link(1, 2)};
  const Plan plan = plan_on(map, {.speed_mps = 5.0});
  for (std::size_t i = 0; i < 25; ++i) EXPECT_LT(distance(plan, arc[i]), 0.1) << i;
  EXPECT_EQ(plan.support_at(arc[25]), Support::mapped);
}

TEST(Planner, CrossesAGapOnTheLinkagesPath) {
  LocalMap map;
  map.lanes = {lane_of(1, straight_line({-20, 0, 0}, {10, 0, 0})),
               lane_of(2, straight_line({25, 1, 0}, {60, 1, 0}))};
  map.linkages = {link(1, 2, Linkage::Turn::straight, {{10, 0, 0}, {15, 0.5, 0}, {20, 0.5, 0}, {25, 1, 0}})};
  const Plan plan = plan_on(map, {.speed_mps = 5.0});
  EXPECT_LT(distance(plan, {17, 0.5, 0}), 0.1);
  EXPECT_LT(distance(plan, {35, 1, 0}), 0.05);
  EXPECT_EQ(plan.support_at({17, 0.5, 0}), Support::mapped);
}

LocalMap crossing() {
  LocalMap map;
  map.lanes = {
      lane_of(1, straight_line({-60, 0, 0}, {-10, 0, 0})), lane_of(2, straight_line({10, 0, 0}, {60, 0, 0})),
      lane_of(3, straight_line({0, 10, 0}, {0, 60, 0})), lane_of(4, straight_line({0, -10, 0}, {0, -60, 0}))};
  map.linkages = {link(1, 2, Linkage::Turn::straight), link(1, 3, Linkage::Turn::left),
                  link(1, 4, Linkage::Turn::right)};
  return map;
}

TEST(Planner, TakesTheWantedTurn) {
  const Bicycle vehicle{.rear_axle = {-20.0, 0.0}, .speed_mps = 5.0};
  EXPECT_LT(distance(plan_on(crossing(), vehicle, {}, WayWish::straight), {15, 0, 0}), 0.1);
  EXPECT_LT(distance(plan_on(crossing(), vehicle, {}, WayWish::left), {0, 14, 0}), 0.1);
  EXPECT_LT(distance(plan_on(crossing(), vehicle, {}, WayWish::right), {0, -14, 0}), 0.1);
}

TEST(Planner, TakesATurnThatComesIntoTheMapLateUnlessItIsPastIt) {
  LocalMap without = crossing();
  std::erase_if(without.linkages, [](const Linkage& linkage) { return linkage.to == 3; });
  const Bicycle before{.rear_axle = {-12.0, 0.0}, .speed_mps = 5.0};
  const Plan straight_on = plan_on(without, before, {}, WayWish::left);
  EXPECT_LT(distance(straight_on, {15, 0, 0}), 0.1);
  EXPECT_LT(distance(plan_on(crossing(), before, straight_on, WayWish::left), {0, 14, 0}), 0.1);
  const Bicycle past{.rear_axle = {-5.0, 0.0}, .speed_mps = 5.0};
  EXPECT_LT(distance(plan_on(crossing(), past, straight_on, WayWish::left), {15, 0, 0}), 0.1);
}

TEST(Planner, KeepsToThePassageThatItHasBegunWhateverLaneComesUp) {
  const Bicycle before{.rear_axle = {-11.0, 0.0}, .speed_mps = 5.0};
  const Plan turning = plan_on(crossing(), before, {}, WayWish::left);
  LocalMap map = crossing();
  map.lanes.push_back(lane_of(5, straight_line({-10, 0, 0}, {10, 0, 0})));  // a ghost across
  const Bicycle within{.rear_axle = {-8.0, 0.1}, .speed_mps = 5.0};
  EXPECT_LT(distance(plan_on(map, within, turning, WayWish::left), {0, 14, 0}), 0.2);
}

TEST(Planner, IsNotBetweenLanesWhereTheOneThatItIsInHasBeenDivided) {
  LocalMap map;
  map.lanes = {lane_of(1, straight_line({-20, 0, 0}, {30, 0, 0})),
               lane_of(2, straight_line({30, 0, 0}, {60, 0, 0}))};
  map.linkages = {link(1, 2)};
  const Bicycle vehicle{.speed_mps = 5.0};
  const Plan before = plan_on(map, vehicle);
  map.lanes[0] = lane_of(1, straight_line({6, 0, 0}, {30, 0, 0}));  // keeps its id
  map.lanes.push_back(lane_of(3, straight_line({-20, 0, 0}, {6, 0, 0})));
  map.linkages.push_back(link(3, 1));
  const Plan plan = plan_on(map, vehicle, before);
  for (const double x : {1.0, 10.0, 25.0, 40.0}) EXPECT_LT(distance(plan, {x, 0, 0}), 0.1) << x;
}

TEST(Planner, SaysThatItLooksForATurnThatIsNotInTheMap) {
  const Bicycle near{.rear_axle = {-20.0, 0.0}, .speed_mps = 5.0}, far{.rear_axle = {-40.0, 0.0}};
  LocalMap map = crossing();
  EXPECT_FALSE(plan_on(map, near, {}, WayWish::left).looks_for_turn);
  std::erase_if(map.linkages, [](const Linkage& linkage) { return linkage.to == 3; });
  EXPECT_TRUE(plan_on(map, near, {}, WayWish::left).looks_for_turn);
  EXPECT_FALSE(plan_on(map, far, {}, WayWish::left).looks_for_turn);
  EXPECT_FALSE(plan_on(map, near, {}, WayWish::straight).looks_for_turn);
}

TEST(Planner, KeepsTheTurnThatItIsInWhenTheLaneBehindIsForgotten) {
  LocalMap map = crossing();
  const Bicycle before{.rear_axle = {-12.0, 0.0}, .speed_mps = 5.0};
  const Plan turning = plan_on(map, before, {}, WayWish::left);
  map.lanes.erase(map.lanes.begin());
  map.linkages.clear();
  const Bicycle within{.rear_axle = {-8.0, 0.1}, .speed_mps = 5.0};
  const Plan plan = plan_on(map, within, turning, WayWish::straight);
  EXPECT_LT(distance(plan, {0, 14, 0}), 0.2);
  EXPECT_EQ(plan.support_at({-5, 0.6, 0}), Support::remembered);
  EXPECT_EQ(plan.support_at({0, 14, 0}), Support::mapped);
  const Plan blind = plan_on({}, within, turning, WayWish::straight);
  EXPECT_LT(distance(blind, {0, 14, 0}), 0.2);
  EXPECT_EQ(blind.support_at({0, 14, 0}), Support::remembered);
}

TEST(Planner, GuessesOnWhereTheLaneEnds) {
  LocalMap map;
  map.lanes = {lane_of(1, straight_line({-20, 0, 0}, {15, 0, 0}))};
  const Plan plan = plan_on(map, {.speed_mps = 5.0});
  EXPECT_EQ(plan.support_at({10, 0, 0}), Support::mapped);
  EXPECT_EQ(plan.support_at({20, 0, 0}), Support::guessed);
  EXPECT_LT(distance(plan, {35, 0, 0}), 0.1);
  EXPECT_GT(MeasuredPolyline(plan.path).length(), 40.0);
}

TEST(Planner, GoesAlongALaneAgainstItsPoints) {
  LocalMap map;
  map.lanes = {lane_of(1, straight_line({20, 0, 0}, {-20, 0, 0})),
               lane_of(2, straight_line({60, 0, 0}, {20, 0, 0}))};
  for (Lane& lane : map.lanes) lane.direction = Lane::Direction::against_centerline;
  map.linkages = {link(2, 1)};
  const Plan plan = plan_on(map, {.rear_axle = {0.0, 0.3}, .speed_mps = 5.0});
  EXPECT_LT(distance(plan, {30, 0, 0}), 0.05);
  EXPECT_EQ(plan.support_at({30, 0, 0}), Support::mapped);
}

/// A lane ahead, along the vehicle's path.
LocalMap lane_ahead(Lane::Direction direction) {
  LocalMap map;
  map.lanes = {lane_of(1, straight_line({-20, 0, 0}, {60, 0, 0}))};
  map.lanes[0].direction = direction;
  return map;
}

TEST(Planner, GoesAgainstTheTrafficOnlyWhereNothingElseIsKnown) {
  const Bicycle vehicle{.speed_mps = 5.0};
  const LocalMap oncoming = lane_ahead(Lane::Direction::against_centerline);
  EXPECT_EQ(plan_on(oncoming, vehicle).support_at({20, 0, 0}), Support::mapped);
  const Plan before = plan_on(lane_ahead(Lane::Direction::along_centerline), vehicle);
  EXPECT_EQ(plan_on(oncoming, vehicle, before).support_at({20, 0, 0}), Support::remembered);
  EXPECT_EQ(plan_on(lane_ahead(Lane::Direction::both), vehicle, before).support_at({20, 0, 0}),
            Support::mapped);
}

TEST(Planner, JoinsALaneAheadOfItButNoPassage) {
  LocalMap map = crossing();
  const Bicycle vehicle{.rear_axle = {-8.0, 0.0}, .speed_mps = 5.0};
  map.linkages = {link(4, 3, Linkage::Turn::straight)};
  const Plan plan = plan_on(map, vehicle);
  EXPECT_LT(distance(plan, {0, 0, 0}), 0.3);
  EXPECT_EQ(plan.support_at({20, 0, 0}), Support::mapped);
}

TEST(Planner, NoMapGivesAPlanStraightOn) {
  const Plan plan = plan_on({}, {.heading_rad = 0.5 * std::numbers::pi});
  EXPECT_LT(distance(plan, {0, 30, 0}), 1e-6);
  EXPECT_TRUE(std::ranges::all_of(plan.support, [](Support s) { return s == Support::guessed; }));
}

TEST(Planner, DoesNotFollowALaneThatCrossesOrLiesBeside) {
  LocalMap map;
  map.lanes = {lane_of(1, straight_line({5, -30, 0}, {5, 30, 0})),
               lane_of(2, straight_line({-20, 3.5, 0}, {50, 3.5, 0}))};
  const Plan plan = plan_on(map, {.speed_mps = 5.0});
  EXPECT_LT(distance(plan, {30, 0, 0}), 1e-6);
}

TEST(Planner, BendsWithoutAJumpToALaneThatHasMoved) {
  LocalMap map;
  map.lanes = {lane_of(1, straight_line({-20, 0, 0}, {200, 0, 0}))};
  const Bicycle vehicle{.rear_axle = {10.0, 0.0}, .speed_mps = 10.0};
  const Plan before = plan_on(map, vehicle);
  map.lanes = {lane_of(9, straight_line({-20, 0.4, 0}, {200, 0.4, 0}))};
  const Plan after = plan_on(map, vehicle, before);
  EXPECT_LT(distance(after, {10, 0, 0}), 0.01);
  EXPECT_LT(distance(after, {12, 0, 0}), 0.05);
  EXPECT_LT(distance(after, {40, 0.4, 0}), 0.01);
  const MeasuredPolyline path(after.path);
  for (double arc_m = 4.0; arc_m < 30.0; arc_m += 1.0)
    EXPECT_LT(std::abs(curvature_at(path, arc_m)), 0.01);  // 6 offset / length^2 at most
}

}  // namespace
}  // namespace laneloom::drive
