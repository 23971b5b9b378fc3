#include <gmock/gmock.h>

#include "mapping/lanes/ways.hpp"

namespace laneloom::lanes {
namespace {

using test::ids;
using test::largest_kink_deg;
using test::road_lane;
using test::straight;
using test::way_on;
using ::testing::ElementsAre;

/// Lane 1 leads east and ends at x = 20; lane 2 begins at x = 45. Somebody drove from one into the other.
LocalMap driven_road() {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {20, 0, 0}), road_lane(2, {45, 1, 0}, {120, 1, 0})};
  map.driven_paths = {{.id = 9, .points = straight({12, 0.5, 0}, {50, 1, 0}, 40), .lateral_stddev_m = 0.6}};
  return map;
}

TEST(Way, GoesOnWhereOthersDrove) {
  LocalMap map = driven_road();
  const Way way = way_on(map, test::at(5));
  EXPECT_NEAR(way.known_m, 60.0, 0.1);
  EXPECT_THAT(ids(way), ElementsAre(1, 2));
  EXPECT_EQ(way.stations[25].status, ElementStatus::inferred) << "between the lanes";
  EXPECT_EQ(way.stations[25].lane, kNoElement);
  EXPECT_EQ(way.stations[25].lateral_stddev_m, 0.6) << "that of the path";
  EXPECT_LT(largest_kink_deg(way, 4.0), 6.0);
  for (const WayStation& station : way.stations) EXPECT_NEAR(station.point.y(), 0.5, 0.8);
  map.lanes[1].direction = Lane::Direction::against_centerline;
  EXPECT_THAT(ids(way_on(map, test::at(5))), ElementsAre(1)) << "not into an oncoming lane";
  EXPECT_NEAR(way_on(map, test::at(5)).known_m, 45.0, 1.0) << "to where they were seen last";
}

TEST(Way, FollowsNoneWhoTurnOffUnlessThatIsTheWish) {
  LocalMap map = driven_road();
  Polyline left = straight({12, 0.5, 0}, {25, 0.5, 0}, 14);
  for (const Point& point : test::arc({25, 10.5, 0}, 10.0, -90.0, 0.0)) left.push_back(point);
  map.driven_paths = {{.id = 9, .points = left}};
  EXPECT_NEAR(way_on(map, test::at(5)).known_m, 15.0, 0.1);
  const Way turned = way_on(map, test::at(5), WayWish::left);
  EXPECT_NEAR(turned.stations.back().point.y(), 10.5, 1.0);
  EXPECT_NEAR(way_on(map, test::at(5), WayWish::right).known_m, 15.0, 0.1);
}

TEST(Way, FollowsNoneIntoABayOrAYard) {
  LocalMap map = driven_road();
  Polyline bay = straight({12, 0, 0}, {24, 0, 0}, 13), yard = bay;
  bay.push_back({44, -3.5, 0});
  bay.push_back({60, -3.5, 0});
  yard.push_back({50, -15, 0});
  for (const Polyline& path : {bay, yard}) {
    map.driven_paths = {{.id = 9, .points = path}};
    for (const WayWish wish : {WayWish::straight, WayWish::right})
      EXPECT_NEAR(way_on(map, test::at(5), wish).known_m, 15.0, 0.1);
  }
}

TEST(Way, GoesOnWhereOthersDroveRoundABend) {
  LocalMap map = driven_road();
  map.lanes.pop_back();
  Polyline bend = straight({12, 0.3, 0}, {25, 0.3, 0}, 14);
  for (const Point& point : test::arc({25, 100.3, 0}, 100.0, -90.0, -65.0)) bend.push_back(point);
  map.driven_paths = {{.id = 9, .points = bend}};
  EXPECT_NEAR(way_on(map, test::at(5)).known_m, 60.0, 4.0);
}

TEST(Way, FollowsNoneBesideItsEndNorAgainstIt) {
  LocalMap map = driven_road();
  for (const Polyline& other :
       {straight({12, 2.5, 0}, {50, 2.5, 0}, 40), straight({50, 0, 0}, {12, 0, 0}, 40),
        straight({32, 0, 0}, {60, 0, 0}, 30), straight({12, 0, 6}, {50, 0, 6}, 40)}) {
    map.driven_paths = {{.id = 9, .points = other}};
    EXPECT_NEAR(way_on(map, test::at(5)).known_m, 15.0, 0.1);
  }
}

TEST(Way, WithoutALaneGoesOnWhereOthersDrove) {
  LocalMap map = driven_road();
  map.lanes.pop_back();
  const Way before = way_on(map, test::at(5));
  map.lanes.clear();
  map.driven_paths[0].points = straight({12, 0.5, 0}, {90, 1, 0}, 80);
  const Way way = way_on(map, test::at(30, 0.8), WayWish::straight, &before);
  EXPECT_NEAR(way.known_m, 60.0, 0.5);
  EXPECT_TRUE(way.lanes.empty());
  map.driven_paths.clear();
  EXPECT_LT(way_on(map, test::at(30, 0.8), WayWish::straight, &before).known_m, 21.0);
}

/// A road whose own way goes on as a street does, from lane 1 to the left of straight on.
LocalMap road_along_street() {
  LocalMap map = driven_road();
  map.driven_paths.clear();
  map.lanes[1] = road_lane(2, {60, 12, 0}, {120, 24, 0});
  Way way;
  for (double s_m = 0.0; s_m <= 20.0; s_m += 1.0)
    way.stations.push_back({.point = {s_m, 0, 0}, .lane = 1, .lateral_stddev_m = 0.2});
  for (double s_m = 1.0; s_m <= 30.0; s_m += 1.0)
    way.stations.push_back({.point = {20 + s_m, 0.2 * s_m, 0}, .lateral_stddev_m = 0.2 + 0.04 * s_m});
  map.way = way;
  return map;
}

TEST(Way, GoesOnAsTheStreetDoesAlongWhichTheMapsOwnWayLeads) {
  LocalMap map = road_along_street();
  const Way way = way_on(map, test::at(5));
  EXPECT_THAT(ids(way), ElementsAre(1));
  EXPECT_NEAR(way.known_m, 45.0, 1.5);
  EXPECT_NEAR(way.stations.back().point.y(), 6.0, 0.5);
  EXPECT_EQ(way.stations.back().status, ElementStatus::inferred);
  EXPECT_NEAR(way.stations.back().lateral_stddev_m, 1.4, 0.1) << "it grows along the street";
  EXPECT_NEAR(way.stations[25].lateral_stddev_m, 0.6, 0.1);
  EXPECT_NEAR(way_on(map, test::at(5), WayWish::left).known_m, 15.0, 0.1) << "the wished turn is not there";
  for (WayStation& station : map.way->stations) station.lateral_stddev_m = 0.6;
  EXPECT_NEAR(way_on(map, test::at(5)).known_m, 15.0, 0.1) << "no street: the deviation does not grow";
}

TEST(Way, EntersTheLaneThatBeginsOnTheStreet) {
  LocalMap map = road_along_street();
  map.lanes[1] = road_lane(2, {45, 5, 0}, {120, 20, 0});
  const Way way = way_on(map, test::at(5));
  EXPECT_THAT(ids(way), ElementsAre(1, 2));
  EXPECT_NEAR(way.known_m, 60.0, 0.1);
  EXPECT_LT(largest_kink_deg(way, 4.0), 12.0);
}

TEST(Way, TheRestAlongAStreetKeepsItsDeviation) {
  const LocalMap map = road_along_street();
  const Way before = way_on(map, test::at(5));
  const Way rest = way_on(map, test::at(32, 2.4), WayWish::straight, &before);
  EXPECT_THAT(ids(rest), ElementsAre());
  EXPECT_NEAR(rest.stations.front().lateral_stddev_m, 0.7, 0.1) << "at the place where it was";
  EXPECT_NEAR(rest.stations.back().lateral_stddev_m, 1.4, 0.1);
}

}  // namespace
}  // namespace laneloom::lanes
