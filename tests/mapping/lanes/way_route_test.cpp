#include <gmock/gmock.h>

#include "mapping/lanes/ways.hpp"

// Which lanes a way leads through.
namespace laneloom::lanes {
namespace {

using test::ids;
using test::link;
using test::road_lane;
using test::way_on;
using ::testing::ElementsAre;
using Turn = Linkage::Turn;

/// Lane 1 leads east, and a turn to the right into lane 2. What lies ahead of lane 1 is not seen yet.
LocalMap intersection() {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {20, 0, 0}), road_lane(2, {32, -12, 0}, {32, -60, 0})};
  map.linkages = {link(1, 2, Turn::right, test::arc({20, -12, 0}, 12.0, 90, 0))};
  return map;
}

TEST(WayRoute, StraightOnDoesNotTurnOffWhereTheFarSideIsNotSeen) {
  const LocalMap map = intersection();
  EXPECT_THAT(ids(way_on(map, test::at(5))), ElementsAre(1));
  EXPECT_THAT(ids(way_on(map, test::at(5), WayWish::left)), ElementsAre(1));
  EXPECT_THAT(ids(way_on(map, test::at(5), WayWish::right)), ElementsAre(1, 2));
}

TEST(WayRoute, StraightOnTurnsOffWhereAnEdgeClosesTheRoad) {
  LocalMap map = intersection();
  map.boundaries = {test::marking(9, {{40, -8, 0}, {40, 8, 0}}, MarkingType::roadedge)};
  EXPECT_THAT(ids(way_on(map, test::at(5))), ElementsAre(1, 2));
  map.boundaries[0].status = ElementStatus::inferred;
  EXPECT_THAT(ids(way_on(map, test::at(5))), ElementsAre(1)) << "nobody saw it";
  map.boundaries[0] = test::marking(9, {{40, -8, 6}, {40, 8, 6}}, MarkingType::roadedge);
  EXPECT_THAT(ids(way_on(map, test::at(5))), ElementsAre(1)) << "on a bridge";
}

TEST(WayRoute, StraightOnFollowsTheBendOfTheRoad) {
  LocalMap map = intersection();
  for (Lane& lane : map.lanes) {
    lane.left_borders = {{7, {0, 20}, lane.id == 1 ? Stretch{0, 20} : Stretch{40, 60}}};
    lane.right_borders = {{8, {0, 20}, lane.id == 1 ? Stretch{0, 20} : Stretch{40, 60}}};
  }
  EXPECT_THAT(ids(way_on(map, test::at(5))), ElementsAre(1, 2));
  map.lanes[1].left_borders[0].boundary = 6;
  EXPECT_THAT(ids(way_on(map, test::at(5))), ElementsAre(1)) << "into another street";
}

TEST(WayRoute, ABranchDoesNotTakeTheWayFromTheLaneThatGoesOn) {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {20, 0, 0}), road_lane(2, {24, 0, 0}, {80, 0, 0}),
               road_lane(3, {22, -3, 0}, {80, -3, 0})};
  map.linkages = {link(1, 3), link(1, 2)};
  map.linkages[0].probability = 0.75;
  map.linkages[1].probability = 0.52;
  EXPECT_THAT(ids(way_on(map, test::at(5))), ElementsAre(1, 2));
  LocalMap branch = map;
  branch.linkages.pop_back();
  const Way before = way_on(branch, test::at(5));
  ASSERT_THAT(ids(before), ElementsAre(1, 3));
  EXPECT_THAT(ids(way_on(map, test::at(6), WayWish::straight, &before)), ElementsAre(1, 2))
      << "the lane that goes on came up later";
}

/// Two streets to the left, at 20 m and at 60 m.
LocalMap two_streets() {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {20, 0, 0}), road_lane(2, {32, 0, 0}, {60, 0, 0}),
               road_lane(3, {72, 0, 0}, {120, 0, 0}), road_lane(4, {32, 12, 0}, {32, 60, 0}),
               road_lane(5, {72, 12, 0}, {72, 60, 0})};
  map.linkages = {link(1, 2), link(2, 3), link(1, 4, Turn::left, test::arc({20, 12, 0}, 12.0, -90, 0)),
                  link(2, 5, Turn::left, test::arc({60, 12, 0}, 12.0, -90, 0))};
  return map;
}

TEST(WayRoute, TurnsWhereTheTurnIs) {
  const LocalMap map = two_streets();
  const auto way = [&](double x, const Stretch& turn_m) {
    return ids(way_on(map, test::at(x), WayWish::left, nullptr, {.reach_m = 90.0, .turn_m = turn_m}));
  };
  EXPECT_THAT(ids(way_on(map, test::at(5), WayWish::left)), ElementsAre(1, 4)) << "at the next street";
  EXPECT_THAT(way(5, {10, 20}), ElementsAre(1, 4));
  EXPECT_THAT(way(5, {50, 60}), ElementsAre(1, 2, 5));
  EXPECT_THAT(way(45, {10, 20}), ElementsAre(2, 5)) << "ahead of the vehicle, not along its lane";
  EXPECT_THAT(way(5, {25, 45}), ElementsAre(1, 2, 3)) << "no street is there";
}

TEST(WayRoute, ABendToThatSideIsNotTheTurn) {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {20, 0, 0}), road_lane(2, {32, -12, 0}, {32, -40, 0}),
               road_lane(3, {20, -52, 0}, {-20, -52, 0}), road_lane(4, {32, -52, 0}, {32, -90, 0})};
  map.linkages = {link(1, 2, Turn::right, test::arc({20, -12, 0}, 12.0, 90, 0)), link(2, 4),
                  link(2, 3, Turn::right, test::arc({20, -40, 0}, 12.0, 0, -90))};
  map.boundaries = {test::marking(9, {{40, -8, 0}, {40, 8, 0}}, MarkingType::roadedge)};
  const WayOptions options{.reach_m = 90.0, .turn_m = Stretch{50, 75}};
  EXPECT_THAT(ids(way_on(map, test::at(5), WayWish::right, nullptr, options)), ElementsAre(1, 2, 3));
}

TEST(WayRoute, TheTurnIsMeasuredFromTheVehicleOnAPassageAndBeforeALane) {
  const LocalMap map = two_streets();
  const auto way = [](const LocalMap& on, double x, const Stretch& turn_m) {
    return ids(way_on(on, test::at(x), WayWish::left, nullptr, {.reach_m = 90.0, .turn_m = turn_m}));
  };
  EXPECT_THAT(way(map, 26, {30, 36}), ElementsAre(2, 5)) << "between lanes 1 and 2";
  EXPECT_THAT(way(map, 26, {37, 60}), ElementsAre(2, 3));
  LocalMap ahead = map;
  std::erase_if(ahead.lanes, [](const Lane& lane) { return lane.id == 1; });
  std::erase_if(ahead.linkages, [](const Linkage& one) { return one.from == 1; });
  EXPECT_THAT(way(ahead, 20, {36, 44}), ElementsAre(2, 5)) << "in no lane";
  EXPECT_THAT(way(ahead, 20, {22, 34}), ElementsAre(2, 3)) << "in no lane";
}

TEST(WayRoute, WhereNoLaneTurnsTheBranchToThatSideIsTaken) {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {20, 0, 0}), road_lane(2, {24, 0, 0}, {80, 0, 0}),
               road_lane(3, {22, -3, 0}, {80, -3, 0})};
  map.linkages = {link(1, 2), link(1, 3)};
  map.linkages[0].probability = 0.9;
  const Way before = way_on(map, test::at(5));
  const auto way = [&](WayWish wish, const WayOptions& options) {
    return ids(way_on(map, test::at(6), wish, &before, options));
  };
  EXPECT_THAT(way(WayWish::right, {.turn_m = Stretch{5, 30}}), ElementsAre(1, 3))
      << "though it was not before";
  EXPECT_THAT(way(WayWish::left, {.turn_m = Stretch{5, 30}}), ElementsAre(1, 2));
  EXPECT_THAT(way(WayWish::right, {.turn_m = Stretch{30, 60}}), ElementsAre(1, 2))
      << "the exit is further on";
  EXPECT_THAT(way(WayWish::right, {}), ElementsAre(1, 2)) << "wherever the turn is, this is none";
}

TEST(WayRoute, APathOfOthersIsFollowedRoundTheTurnWhereTheTurnIs) {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {20, 0, 0})};
  map.driven_paths = {{.id = 9, .points = test::arc({20, 14, 0}, 14.0, -90, 0), .lateral_stddev_m = 0.6}};
  const auto length_m = [&](const Stretch& turn_m) {
    return way_on(map, test::at(5), WayWish::left, nullptr, {.turn_m = turn_m}).known_m;
  };
  EXPECT_GT(length_m({10, 20}), 30.0);
  EXPECT_LT(length_m({20, 40}), 16.0) << "the turn is further on";
}

TEST(WayRoute, AtItsBorderTheVehicleStaysInTheLaneOfTheWayBefore) {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {120, 0, 0}), road_lane(2, {120, 3.5, 0}, {0, 3.5, 0})};
  const Way before = way_on(map, test::at(10));
  ASSERT_THAT(ids(before), ElementsAre(1));
  EXPECT_THAT(ids(way_on(map, test::at(11, 2.1), WayWish::straight, &before)), ElementsAre(1));
  EXPECT_THAT(ids(way_on(map, test::at(11, 2.1))), ElementsAre(2)) << "without a way before";
  EXPECT_THAT(ids(way_on(map, test::at(11, 2.6), WayWish::straight, &before)), ElementsAre(2))
      << "it is in the other lane";
}

TEST(WayRoute, OfTwoLanesThatOverlapItIsNotTheOncomingOne) {
  LocalMap map;
  map.lanes = {road_lane(1, {120, 0.5, 0}, {0, 0.5, 0}), road_lane(2, {0, -0.5, 0}, {120, -0.6, 0})};
  for (Lane& lane : map.lanes) lane.direction = Lane::Direction::along_centerline;
  EXPECT_THAT(ids(way_on(map, test::at(10))), ElementsAre(2));
}

}  // namespace
}  // namespace laneloom::lanes
