#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mapping/lanes/ways.hpp"

namespace laneloom::lanes {
namespace {

using test::ids;
using test::largest_curvature_per_m;
using test::link;
using test::road_lane;
using test::shifted;
using test::straight;
using test::way_on;
using ::testing::ElementsAre;
using Turn = Linkage::Turn;

/// Lane 1 leads east into lane 2 (straight on), 3 (left) and 4 (right), each behind a path.
LocalMap fork() {
  LocalMap map;
  const Polyline left = test::arc({20, 12, 0}, 12.0, -90, 0), right = test::arc({20, -12, 0}, 12.0, 90, 0);
  map.lanes = {road_lane(1, {0, 0, 0}, {20, 0, 0}), road_lane(2, {32, 0, 0}, {80, 0, 0}),
               road_lane(3, {32, 12, 0}, {32, 60, 0}), road_lane(4, {32, -12, 0}, {32, -60, 0})};
  map.linkages = {link(1, 2, Turn::straight, straight({20, 0, 0}, {32, 0, 0}, 13)),
                  link(1, 3, Turn::left, left), link(1, 4, Turn::right, right)};
  return map;
}

/// Lanes 1 and 2 lead east, lane 2 on the left; the line between them is dashed from 0 to 100 m.
LocalMap two_lanes() {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {120, 0, 0}), road_lane(2, {0, 3.5, 0}, {120, 3.5, 0})};
  map.lanes[0].left_neighbours = {{.lane = 2, .range = {0, 120}, .crossable = {{0, 100}}}};
  map.lanes[1].right_neighbours = {{.lane = 1, .range = {0, 120}, .crossable = {{0, 100}}}};
  return map;
}

TEST(Way, OnAPassageOfOncomingTrafficDoesNotStart) {
  LocalMap map;
  map.lanes = {road_lane(1, {80, 3.5, 0}, {32, 3.5, 0}), road_lane(2, {20, 3.5, 0}, {0, 3.5, 0})};
  map.linkages = {link(1, 2, Turn::straight, straight({32, 3.5, 0}, {20, 3.5, 0}, 13))};
  const Eigen::Isometry3d east = test::at(26, 2.5), west = test::at(26, 2.5, std::numbers::pi);
  EXPECT_THAT(ids(way_on(map, east)), ElementsAre(1)) << "nothing is known of it";
  for (Lane& lane : map.lanes) lane.direction = Lane::Direction::along_centerline;
  EXPECT_THAT(ids(way_on(map, east)), ElementsAre());
  EXPECT_THAT(ids(way_on(map, west)), ElementsAre(2));
}

TEST(Way, IsConfirmedNoFurtherThanItIsKnown) {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {15, 0, 0})};
  map.lanes[0].status = ElementStatus::confirmed;
  map.lanes[0].inferred_ranges = {{14.5, 15.0}};
  const Way way = way_on(map, test::at(10.0 + 5e-10));
  ASSERT_EQ(way.stations.size(), 6U);
  ASSERT_LT(way.known_m, way.length());
  EXPECT_LE(way.confirmed_m, way.known_m);
}

TEST(Way, OnAStraightRoadRunsInTheMiddleOfTheLaneFromBesideTheVehicle) {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {100, 0, 0})};
  map.lanes[0].left_borders = {{7, {0, 100}, {0, 100}}};
  map.lanes[0].right_borders = {{8, {0, 100}, {0, 100}}};
  map.boundaries = {test::marking(7, map.lanes[0].left), test::marking(8, map.lanes[0].right)};
  map.boundaries[0].lateral_stddev_m.assign(map.boundaries[0].points.size(), 0.06);
  map.boundaries[1].lateral_stddev_m.assign(map.boundaries[1].points.size(), 0.08);
  const Way way = way_on(map, test::at(20, 0.8, 0.1));
  ASSERT_EQ(way.stations.size(), 61U);
  EXPECT_NEAR(way.known_m, 60.0, 1e-9);
  EXPECT_NEAR(way.confirmed_m, 60.0, 1e-9);
  EXPECT_THAT(ids(way), ElementsAre(1));
  EXPECT_NEAR(way.lanes[0].range.to_m, 60.0, 1e-9);
  for (std::size_t i = 0; i < way.stations.size(); ++i) {
    const WayStation& station = way.stations[i];
    EXPECT_NEAR((station.point - Point(20.0 + static_cast<double>(i), 0, 0)).norm(), 0.0, 1e-6);
    EXPECT_NEAR(station.direction().x(), 1.0, 1e-9);
    EXPECT_NEAR(station.curvature_per_m, 0.0, 1e-9);
    EXPECT_NEAR(station.left_m, 1.75, 1e-6);
    EXPECT_NEAR(station.right_m, 1.75, 1e-6);
    EXPECT_NEAR(station.width_m, 3.5, 1e-6);
    EXPECT_NEAR(station.lateral_stddev_m, 0.05, 1e-9);
    EXPECT_EQ(station.lane, 1U);
  }
}

TEST(Way, WhereABorderChangesOrIsUnseenTheDeviationsAreThoseOfWhatIsThere) {
  for (const bool against : {false, true}) {
    LocalMap map;
    map.lanes = {road_lane(1, {0, 0, 0}, {100, 0, 0})};
    map.lanes[0].left_borders = {{7, {0, 40}, {0, 40}}, {9, {40, 100}, {40, 100}}};
    map.lanes[0].right_borders = {{8, {0, 60}, {0, 60}}, {kNoElement, {60, 100}, {}}};
    const auto add = [&](ElementId id, const Polyline& points, double stddev_m) {
      map.boundaries.push_back(test::marking(id, points));
      map.boundaries.back().lateral_stddev_m.assign(points.size(), stddev_m);
    };
    add(7, map.lanes[0].left, 0.06);
    add(8, map.lanes[0].right, 0.08);
    add(9, map.lanes[0].left, 0.15);
    const Way way = against ? way_on(map, test::at(85, 0, std::numbers::pi)) : way_on(map, test::at(25));
    ASSERT_EQ(way.stations.size(), 61U);
    for (const WayStation& station : way.stations) {
      const double x = station.point.x();
      if (std::abs(x - 40.0) < 1.0 || std::abs(x - 60.0) < 1.0) continue;
      const double expected_m = x < 40.0 ? 0.05 : x < 60.0 ? 0.085 : kNotKnown_m;
      EXPECT_NEAR(station.lateral_stddev_m, expected_m, 1e-9) << x;
      EXPECT_NEAR(station.width_m, 3.5, 1e-6) << x;
    }
  }
}

TEST(Way, DoesNotLeadOntoAShoulderOrParkingStrip) {
  for (const Lane::Use use : {Lane::Use::shoulder, Lane::Use::parking}) {
    LocalMap map;
    map.lanes = {road_lane(1, {0, 0, 0}, {40, 0, 0}), road_lane(2, {40, 0, 0}, {80, 0, 0})};
    map.linkages = {link(1, 2)};
    EXPECT_THAT(ids(way_on(map, test::at(10))), ElementsAre(1, 2));
    map.lanes[1].use = use;
    EXPECT_THAT(ids(way_on(map, test::at(10))), ElementsAre(1));
    LocalMap beside = two_lanes();
    EXPECT_TRUE(way_on(beside, test::at(10)).stations[5].may_change_left);
    beside.lanes[1].use = use;
    EXPECT_FALSE(way_on(beside, test::at(10)).stations[5].may_change_left);
    EXPECT_EQ(way_on(beside, test::at(10), WayWish::change_left).change.to, kNoElement);
    EXPECT_THAT(ids(way_on(beside, test::at(10, 3.5))), ElementsAre(2)) << "the vehicle is there already";
  }
}

TEST(Way, AChangeThatLiesAheadIsWishedFurtherWhereItsLaneGetsAnotherId) {
  LocalMap map = two_lanes();
  map.lanes[0].left_neighbours[0].crossable = {{60.0, 100.0}};
  const Way before = way_on(map, test::at(10), WayWish::change_left);
  ASSERT_THAT(ids(before), ElementsAre(1, 2));
  ASSERT_GT(before.change.begin.x() - 10.0, 0.5 * before.change.length_m);
  map.lanes[1].id = map.lanes[0].left_neighbours[0].lane = 9;
  EXPECT_THAT(ids(way_on(map, test::at(11), WayWish::change_left, &before)), ElementsAre(1, 9));
}

TEST(Way, ALaneThatIsDrivenBothWaysIsNoneToChangeTo) {
  LocalMap map = two_lanes();
  map.lanes[1].direction = Lane::Direction::both;
  EXPECT_FALSE(way_on(map, test::at(10)).stations[5].may_change_left);
  EXPECT_THAT(ids(way_on(map, test::at(10, 3.5))), ElementsAre(2));
}

TEST(Way, AgainstTheOrderOfALanesPointsItsSidesAreThoseOfTheVehicle) {
  LocalMap map = two_lanes();
  map.lanes[0].left = shifted(map.lanes[0].centerline, 1.5);
  const Way way = way_on(map, test::at(90, 0, std::numbers::pi));
  ASSERT_EQ(way.stations.size(), 61U);
  EXPECT_TRUE(way.lanes[0].against);
  EXPECT_NEAR(way.stations[10].point.x(), 80.0, 1e-6);
  EXPECT_NEAR(way.stations[10].left_m, 1.75, 1e-6);
  EXPECT_NEAR(way.stations[10].right_m, 1.5, 1e-6);
  EXPECT_TRUE(way.stations[10].may_change_right);
  EXPECT_FALSE(way.stations[10].may_change_left);
}

TEST(Way, ALaneThatComesUpAcrossAPassageThatWasBegunDoesNotEndIt) {
  LocalMap map = fork();
  const Way before = way_on(map, test::at(15), WayWish::left);
  ASSERT_THAT(ids(before), ElementsAre(1, 3));
  map.lanes.push_back(road_lane(5, {21, 0, 0}, {60, 0, 0}));
  const Eigen::Isometry3d on_passage = test::at(24, 0.7, 0.33);
  EXPECT_THAT(ids(way_on(map, on_passage, WayWish::left)), ElementsAre(5)) << "begins in the lane";
  EXPECT_THAT(ids(way_on(map, on_passage, WayWish::left, &before)), ElementsAre(3));
}

TEST(Way, LeadsWhereItIsWishedAtAFork) {
  const LocalMap map = fork();
  const Way straight_on = way_on(map, test::at(5)), left = way_on(map, test::at(5), WayWish::left),
            right = way_on(map, test::at(5), WayWish::right);
  EXPECT_THAT(ids(straight_on), ElementsAre(1, 2));
  EXPECT_THAT(ids(left), ElementsAre(1, 3));
  EXPECT_THAT(ids(right), ElementsAre(1, 4));
  EXPECT_NEAR(left.stations.back().direction().y(), 1.0, 0.01);
  EXPECT_NEAR(right.stations.back().direction().y(), -1.0, 0.01);
  EXPECT_LT(largest_curvature_per_m(left), 1.25 / 12.0);
  EXPECT_NEAR(left.confirmed_m, 15.0, 1.0) << "nobody saw a lane on the passage";
  EXPECT_EQ(left.stations[20].lane, kNoElement);
  EXPECT_EQ(left.stations[20].left_m, kNotKnown_m);
}

TEST(Way, KeepsABranchWhileItLasts) {
  LocalMap map = fork();
  map.lanes[2] = road_lane(3, {32, 1, 0}, {80, 20, 0});
  map.lanes[3] = road_lane(4, {32, -1, 0}, {80, -20, 0});
  for (Linkage& linkage : map.linkages) linkage.turn = Turn::straight;
  map.linkages[1].path = straight({20, 0, 0}, {32, 1, 0}, 13);
  map.linkages[2].path = straight({20, 0, 0}, {32, -1, 0}, 13);
  map.linkages[0].probability = 0.9;
  const Way first = way_on(map, test::at(5));
  ASSERT_THAT(ids(first), ElementsAre(1, 2));
  map.linkages[0].probability = 0.3;
  EXPECT_THAT(ids(way_on(map, test::at(6))), ElementsAre(1, 3)) << "no way before";
  const Way second = way_on(map, test::at(6), WayWish::straight, &first);
  EXPECT_THAT(ids(second), ElementsAre(1, 2));
  map.linkages[2].turn = Turn::right;
  EXPECT_THAT(ids(way_on(map, test::at(7), WayWish::right, &second)), ElementsAre(1, 4)) << "another wish";
  map.linkages.erase(map.linkages.begin());
  EXPECT_THAT(ids(way_on(map, test::at(7), WayWish::straight, &second)), ElementsAre(1, 3)) << "it is gone";
}

TEST(Way, TakesTheWishedTurnOnceTheMapHasIt) {
  LocalMap map = fork();
  const Linkage left = map.linkages[1];
  map.linkages.erase(map.linkages.begin() + 1);
  const Way first = way_on(map, test::at(5), WayWish::left);
  EXPECT_THAT(ids(first), ElementsAre(1, 2));
  map.linkages.push_back(left);
  EXPECT_THAT(ids(way_on(map, test::at(6), WayWish::left, &first)), ElementsAre(1, 3));
}

TEST(Way, ChangesToTheLaneOnTheLeftWhereThatIsAllowed) {
  const LocalMap map = two_lanes();
  Way way = way_on(map, test::at(10), WayWish::change_left);
  ASSERT_THAT(ids(way), ElementsAre(1, 2));
  EXPECT_NEAR(way.stations.front().point.y(), 0.0, 0.05);
  EXPECT_NEAR(way.stations.back().point.y(), 3.5, 0.02);
  EXPECT_LT(largest_curvature_per_m(way), 0.02);
  // It stays where it is in the map while the vehicle follows it.
  const Way first = way;
  for (double s_m = 1.0; s_m < 55.0; s_m += 1.0) {
    const Point vehicle = first.to_map({s_m, 0.0});
    way = way_on(map, test::at(vehicle.x(), vehicle.y()), WayWish::change_left, &way);
    ASSERT_FALSE(way.stations.empty()) << s_m;
    EXPECT_NEAR(way.to_way(vehicle).d_m, 0.0, 0.03) << s_m;
  }
  EXPECT_THAT(ids(way), ElementsAre(2));
}

TEST(Way, ChangesOnlyOnceForOneWish) {
  LocalMap map = two_lanes();
  map.lanes.push_back(road_lane(3, {0, 7, 0}, {120, 7, 0}));
  map.lanes[1].left_neighbours = {{.lane = 3, .range = {0, 120}, .crossable = {{0, 120}}}};
  const Way first = way_on(map, test::at(10), WayWish::change_left);
  const Way last = way_on(map, test::at(60, 3.5), WayWish::change_left, &first);
  EXPECT_NEAR(last.stations.back().point.y(), 3.5, 0.02);
  const Way again = way_on(map, test::at(60, 3.5), WayWish::change_left);
  EXPECT_NEAR(again.stations.back().point.y(), 7.0, 0.02);
}

TEST(Way, DoesNotChangeWhereThatIsForbidden) {
  LocalMap solid = two_lanes(), oncoming = two_lanes(), turned = two_lanes();
  solid.lanes[0].left_neighbours[0].crossable.clear();
  oncoming.lanes[1].direction = Lane::Direction::against_centerline;
  std::ranges::reverse(turned.lanes[1].centerline);
  turned.lanes[1].direction = Lane::Direction::along_centerline;
  for (const LocalMap& map : {solid, oncoming, turned}) {
    const Way way = way_on(map, test::at(10), WayWish::change_left);
    EXPECT_THAT(ids(way), ElementsAre(1));
    EXPECT_NEAR(way.stations.back().point.y(), 0.0, 1e-6);
    EXPECT_FALSE(way.stations[20].may_change_left);
  }
  EXPECT_THAT(ids(way_on(two_lanes(), test::at(10), WayWish::change_right)), ElementsAre(1)) << "no lane";
}

TEST(Way, ChangesOnlyAcrossTheDashedStretch) {
  LocalMap map = two_lanes();
  map.lanes[0].left_neighbours[0].crossable = {{50, 100}};
  const Way way = way_on(map, test::at(10), WayWish::change_left);
  for (const WayStation& station : way.stations)
    EXPECT_LT(station.point.y(), station.point.x() < 50.0 ? 1.0 : 3.6);
  EXPECT_FALSE(way.stations[35].may_change_left);
  EXPECT_TRUE(way.stations[42].may_change_left);
}

TEST(Way, GoesOnAlongThePassageThatTheVehicleIsOn) {
  LocalMap map = fork();
  const Way first = way_on(map, test::at(18), WayWish::left);
  const Eigen::Isometry3d at_begin = test::at(21, 0.05, 0.05), within = test::at(28.5, 3.5, 0.8);
  EXPECT_THAT(ids(way_on(map, at_begin, WayWish::left, &first)), ElementsAre(3)) << "as the way before";
  EXPECT_THAT(ids(way_on(map, test::at(27, 0))), ElementsAre(2)) << "by its direction";
  const Way way = way_on(map, within);
  EXPECT_THAT(ids(way), ElementsAre(3));
  EXPECT_LT(std::abs(way.to_way(within.translation()).s_m), 0.1);
  EXPECT_EQ(way.stations.front().lane, kNoElement);
  EXPECT_EQ(way.confirmed_m, 0.0);
}

TEST(Way, LeadsIntoALaneThatBeginsAheadOfAVehicleInNone) {
  LocalMap map;
  map.lanes = {road_lane(1, {12, 0.5, 0}, {60, 0.5, 0})};
  const Way way = way_on(map, test::at(0));
  ASSERT_THAT(ids(way), ElementsAre(1));
  EXPECT_EQ(way.lanes.front().entry, Turn::straight);
  EXPECT_NEAR(way.lanes.front().range.from_m, 12.0, 1.0);
  EXPECT_NEAR(way.known_m, 60.0, 0.5);
  EXPECT_EQ(way.confirmed_m, 0.0);
  EXPECT_LT(way.stations.front().point.norm(), 0.1);
  EXPECT_EQ(way.stations.front().lane, kNoElement);
  EXPECT_EQ(way.stations.front().status, ElementStatus::inferred);
  EXPECT_EQ(way.stations.back().status, ElementStatus::confirmed);
  EXPECT_NEAR(way.to_way({30, 0.5, 0}).d_m, 0.0, 0.05);
  const Way next = way_on(map, test::at(1), WayWish::straight, &way);
  EXPECT_THAT(ids(next), ElementsAre(1)) << "and goes on to";
}

TEST(Way, LeadsIntoNoLaneAheadThatIsFarOrAsideOrAcrossOrOncomingOrBehindAnEdge) {
  const auto leads_into = [](const Lane& lane, std::vector<Marking> boundaries = {}) {
    LocalMap map;
    map.lanes = {lane};
    map.boundaries = std::move(boundaries);
    return way_ahead(LaneGraph(map), test::at(0), WayWish::straight).has_value();
  };
  EXPECT_TRUE(leads_into(road_lane(1, {12, 0, 0}, {60, 0, 0})));
  EXPECT_TRUE(leads_into(road_lane(1, {60, 0, 0}, {12, 0, 0}))) << "walked against its points";
  EXPECT_FALSE(leads_into(road_lane(1, {22, 0, 0}, {60, 0, 0}))) << "far";
  EXPECT_FALSE(leads_into(road_lane(1, {12, 2.4, 0}, {60, 2.4, 0}))) << "aside";
  EXPECT_FALSE(leads_into(road_lane(1, {12, 0, 0}, {40, 28, 0}))) << "across";
  Lane oncoming = road_lane(1, {12, 0, 0}, {60, 0, 0});
  oncoming.direction = Lane::Direction::against_centerline;
  EXPECT_FALSE(leads_into(oncoming));
  Lane shoulder = road_lane(1, {12, 0, 0}, {60, 0, 0});
  shoulder.use = Lane::Use::shoulder;
  EXPECT_FALSE(leads_into(shoulder));
  const Marking across = test::marking(7, {{6, -4, 0}, {6, 4, 0}}, MarkingType::roadedge);
  EXPECT_FALSE(leads_into(road_lane(1, {12, 0, 0}, {60, 0, 0}), {across})) << "behind an edge";
}

TEST(Way, AWayBeforeWithoutStationsIsNone) {
  const LocalMap nothing;
  const Way before;
  EXPECT_FALSE(way_ahead(LaneGraph(nothing), test::at(18), WayWish::straight, &before).has_value());
}

TEST(Way, GoesOnWhereTheMapHasLostTheLanesOfTheWayBefore) {
  const LocalMap map = fork(), nothing;
  const Way before = way_on(map, test::at(18), WayWish::left);
  ASSERT_THAT(ids(before), ElementsAre(1, 3));
  const Eigen::Isometry3d within = test::at(28.5, 3.5, 0.8);
  const Way rest = way_on(nothing, within, WayWish::left, &before);
  ASSERT_GE(rest.stations.size(), 20U);
  EXPECT_THAT(ids(rest), ElementsAre());
  EXPECT_EQ(rest.confirmed_m, 0.0);
  EXPECT_EQ(rest.known_m, rest.length());
  EXPECT_LT((rest.stations.front().point - within.translation()).norm(), 1.5);
  const std::size_t shed = before.stations.size() - rest.stations.size();
  for (std::size_t i = 0; i < rest.stations.size(); ++i) {
    EXPECT_EQ(rest.stations[i].point, before.stations[i + shed].point) << "it does not move";
    EXPECT_EQ(rest.stations[i].status, ElementStatus::inferred);
    EXPECT_EQ(rest.stations[i].lane, kNoElement);
  }
  const auto has_way = [&](const Eigen::Isometry3d& at, WayWish wish) {
    return way_ahead(LaneGraph(nothing), at, wish, &before).has_value();
  };
  EXPECT_TRUE(has_way(within, WayWish::left));
  EXPECT_TRUE(has_way(within, WayWish::straight)) << "the turn was begun";
  EXPECT_FALSE(has_way(test::at(28.5, 6.5, 0.8), WayWish::left)) << "beside it";
  EXPECT_FALSE(has_way(test::at(28.5, 3.5, -2.3), WayWish::left)) << "against it";
  EXPECT_FALSE(has_way(test::at(200, 0, 0), WayWish::left)) << "beyond it";
  EXPECT_THAT(ids(way_on(map, within, WayWish::left, &rest)), ElementsAre(3)) << "the lanes are back";
}

TEST(Way, EndsWhereTheMapEnds) {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {50, 0, 0})};
  map.lanes[0].inferred_ranges = {{30.0, 40.0}};
  const Way way = way_on(map, test::at(12.5));
  EXPECT_NEAR(way.known_m, 37.0, 0.01);
  EXPECT_EQ(way.stations.size(), 38U);
  EXPECT_NEAR(way.confirmed_m, 18.0, 1e-9);
  EXPECT_FALSE(way_ahead(LaneGraph(map), test::at(60), WayWish::straight)) << "behind the end";
  EXPECT_FALSE(way_ahead(LaneGraph(map), test::at(49.8), WayWish::straight)) << "nothing is left";
  EXPECT_FALSE(way_ahead(LaneGraph(map), test::at(20, 5), WayWish::straight)) << "beside";
  const LocalMap nothing;
  EXPECT_FALSE(way_ahead(LaneGraph(nothing), test::at(0), WayWish::straight));
}

TEST(Way, CoordinatesGoThereAndBack) {
  const LocalMap map = fork();
  const Way way = way_on(map, test::at(5), WayWish::left);
  for (double s_m = -5.0; s_m < 65.0; s_m += 0.37) {
    for (const double d_m : {-3.0, 0.0, 1.2, 4.0}) {
      const WayPlace back = way.to_way(way.to_map({s_m, d_m}));
      EXPECT_NEAR(back.s_m, s_m, 1e-6) << d_m;
      EXPECT_NEAR(back.d_m, d_m, 1e-6) << s_m;
    }
  }
  EXPECT_NEAR(way.to_way({8, 1, 0}).s_m, 3.0, 0.03);
  EXPECT_NEAR(way.to_way({8, 1, 0}).d_m, 1.0, 0.03);
}

}  // namespace
}  // namespace laneloom::lanes
