#include "drive/navigator.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "simulation/scenarios.hpp"

namespace laneloom::drive {
namespace {

TEST(Navigator, WantsTheTurnsOfTheDrive) {
  const simulation::Road road = simulation::make_scenario("t_intersection");  // from the south to the west
  const LaneTracker lanes(road);
  Navigator navigator(road, lanes);
  const Navigator::Start start = navigator.at_begin();
  EXPECT_NEAR((start.vehicle.rear_axle - road.drive.pose_at(0.0).position.head<2>()).norm(), 0.0, 0.2);
  const auto ahead = [&](double north_m) { return navigator.next_turn({1.7, north_m, 0.0}); };
  EXPECT_EQ(ahead(-100.0).turn, Linkage::Turn::left);
  EXPECT_NEAR(ahead(-100.0).distance_m, 88.5 + 10.4, 1.0) << "to the edge, and half of the bend";
  EXPECT_NEAR(ahead(-60.0).distance_m, 48.5 + 10.4, 1.0);
}

/// The lane that leads from the place of `start` into the intersection, and all that cross from its end.
TEST(Navigator, PlansAnewFromATurnThatWasMissed) {
  const simulation::Road road = simulation::make_scenario("intersection");
  const LaneTracker lanes(road);
  Navigator navigator(road, lanes);
  const std::size_t begin = navigator.at_begin().lane;
  EXPECT_FALSE(navigator.follow({begin}));
  const std::vector<std::size_t>& across = lanes.successors()[begin];
  ASSERT_EQ(across.size(), 3U);
  EXPECT_FALSE(navigator.follow(across));
  int missed = 0;
  for (const std::size_t crossing : across) {
    navigator.at_begin();
    navigator.follow(across);
    EXPECT_FALSE(navigator.follow({crossing})) << "it shows behind the intersection";
    if (navigator.follow(lanes.successors()[crossing])) ++missed;
  }
  EXPECT_EQ(missed, 2);
}

TEST(Navigator, GoesRoundATownAndPutsOntoTheRouteFurtherOn) {
  const simulation::Road road = simulation::make_scenario("town");
  const LaneTracker lanes(road);
  Navigator navigator(road, lanes);
  const Navigator::Start start = navigator.at_begin();
  const Navigator::Start later = navigator.further_on(start.vehicle.rear_axle, 20.0);
  EXPECT_NEAR((later.vehicle.rear_axle - start.vehicle.rear_axle).norm(), 20.0, 0.1);
  std::size_t lane = start.lane;
  double route_m = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Navigator::Start next = navigator.further_on(lanes.centerline(lane).at(1e9).head<2>(), 1.0);
    EXPECT_FALSE(road.lanes[next.lane].in_intersection);
    if (next.lane == start.lane) break;
    lane = next.lane;
    route_m += lanes.centerline(lane).length();
  }
  EXPECT_GT(route_m, 1000.0);
  EXPECT_LT(route_m, 1600.0);
}

TEST(Navigator, WhereARoadEndsItGoesBackToTheDrive) {
  const simulation::Road road = simulation::make_scenario("t_intersection");
  const LaneTracker lanes(road);
  Navigator navigator(road, lanes);
  const std::size_t begin = navigator.at_begin().lane;
  navigator.follow({begin});
  const Navigator::Start behind = navigator.back_on_drive();  // behind the intersection
  EXPECT_LT(behind.vehicle.rear_axle.x(), -10.0);
  EXPECT_EQ(navigator.back_on_drive().lane, begin);  // that was the last lane
}

TEST(Navigator, RefusesADriveOffTheLanes) {
  simulation::Road road = simulation::make_scenario("straight");
  const LaneTracker lanes(road);
  road.drive = simulation::Drive::along({{0, 500, 0}, {100, 500, 0}}, 10.0);
  EXPECT_THROW(Navigator(road, lanes), std::runtime_error);
}

}  // namespace
}  // namespace laneloom::drive
