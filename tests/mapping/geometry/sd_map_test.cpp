#include "laneloom/sd_map.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "mapping/shapes.hpp"

namespace laneloom {
namespace {

using test::straight;
using ::testing::ElementsAre;
using Verdict = SdMap::Verdict;

/// A main street from west to east through (0, 0), and a side street to the north.
std::vector<SdWay> crossing_streets() {
  return {{.id = 1, .nodes = {10, 11, 12}, .points = {{-100, 0}, {0, 0}, {100, 0}}},
          {.id = 2, .nodes = {11, 13}, .points = {{0, 0}, {0, 100}}}};
}

const Polyline kFromWest = straight({-30, -2, 0}, {-10, -2, 0}), kToEast = straight({10, -2, 0}, {30, -2, 0}),
               kToNorth = straight({2, 10, 0}, {2, 30, 0}), kFromNorth = straight({-2, 30, 0}, {-2, 10, 0}),
               kToWest = straight({-10, 2, 0}, {-30, 2, 0});

TEST(SdMap, StreetsThatMeetAreConnected) {
  const SdMap map(crossing_streets(), {});
  EXPECT_EQ(map.verdict(kFromWest, kToEast), Verdict::connected);
  EXPECT_EQ(map.verdict(kFromWest, kToNorth), Verdict::connected);
  EXPECT_EQ(map.verdict(kFromNorth, kToWest), Verdict::connected);
}

TEST(SdMap, AboutTurnsAreForbidden) {
  EXPECT_EQ(SdMap(crossing_streets(), {}).verdict(kFromWest, kToWest), Verdict::forbidden);
}

TEST(SdMap, StreetsThatDoNotMeetAreNotConnected) {
  std::vector<SdWay> ways = crossing_streets();
  ways[1].nodes = {99, 13};  // a bridge over the main street
  EXPECT_EQ(SdMap(ways, {}).verdict(kFromWest, kToNorth), Verdict::forbidden);
}

TEST(SdMap, AOnewayStreetIsNotEnteredAgainstItsSense) {
  std::vector<SdWay> ways = crossing_streets();
  ways[1].oneway = true;  // leads north
  EXPECT_EQ(SdMap(ways, {}).verdict(kFromWest, kToNorth), Verdict::connected);
  EXPECT_EQ(SdMap(ways, {}).verdict(kFromNorth, kToWest), Verdict::unknown);  // no such lane can be
}

TEST(SdMap, RestrictionsHold) {
  const SdRestriction no_left{.from_way = 1, .via_node = 11, .to_way = 2};
  EXPECT_EQ(SdMap(crossing_streets(), {no_left}).verdict(kFromWest, kToNorth), Verdict::forbidden);
  EXPECT_EQ(SdMap(crossing_streets(), {no_left}).verdict(kFromWest, kToEast), Verdict::connected);
  const SdRestriction only_straight{.from_way = 1, .via_node = 11, .to_way = 1, .only = true};
  EXPECT_EQ(SdMap(crossing_streets(), {only_straight}).verdict(kFromWest, kToNorth), Verdict::forbidden);
  EXPECT_EQ(SdMap(crossing_streets(), {only_straight}).verdict(kFromWest, kToEast), Verdict::connected);
}

TEST(SdMap, LanesBesideEveryStreetAreUnknown) {
  const SdMap map(crossing_streets(), {});
  EXPECT_EQ(map.verdict(straight({-30, -40, 0}, {-10, -40, 0}), kToEast), Verdict::unknown);
  EXPECT_EQ(SdMap().verdict(kFromWest, kToEast), Verdict::unknown);
}

TEST(SdMap, AcrossADualCarriagewayTheShortWayBetweenItsNodesCounts) {
  const SdMap map({{.id = 1, .nodes = {1, 2, 3}, .points = {{-100, 0}, {0, 0}, {100, 0}}, .oneway = true},
                   {.id = 2, .nodes = {4, 5, 6}, .points = {{100, 12}, {0, 12}, {-100, 12}}, .oneway = true},
                   {.id = 3, .nodes = {2, 5}, .points = {{0, 0}, {0, 12}}},
                   {.id = 4, .nodes = {5, 7}, .points = {{0, 12}, {0, 100}}}},
                  {});
  EXPECT_EQ(map.verdict(kFromWest, straight({2, 25, 0}, {2, 40, 0})), Verdict::connected);
  EXPECT_EQ(map.verdict(kFromWest, straight({-10, 12, 0}, {-30, 12, 0})), Verdict::connected);
}

TEST(SdMap, ALongSlantingStreetIsFoundAllAlong) {
  const SdMap map({{.id = 1, .nodes = {1, 2}, .points = {{0, 0}, {4000, 3000}}}}, {});
  const Point along(0.8, 0.6, 0.0), left(-0.6, 0.8, 0.0);
  const auto verdict_at = [&](double along_m, double left_m) {
    const Point at = along_m * along + left_m * left;
    return map.verdict(straight(at, at + 10.0 * along), straight(at + 20.0 * along, at + 30.0 * along));
  };
  for (double along_m = 0.0; along_m < 4950.0; along_m += 7.0) {
    for (const double left_m : {-14.9, 0.0, 14.9})
      EXPECT_EQ(verdict_at(along_m, left_m), Verdict::connected) << along_m << " " << left_m;
    for (const double left_m : {-15.1, 15.1})
      EXPECT_EQ(verdict_at(along_m, left_m), Verdict::unknown) << along_m << " " << left_m;
  }
}

TEST(SdMap, AOneWayStreetTellsWhichWayTrafficRunsBesideIt) {
  const Eigen::Vector2d north = Eigen::Vector2d::UnitY(), east = Eigen::Vector2d::UnitX();
  std::vector<SdWay> ways = crossing_streets();
  EXPECT_EQ(SdMap(ways, {}).one_way_at({5, 50}, north), 0) << "either way";
  ways[1].oneway = true;  // leads north
  const SdMap map(ways, {});
  EXPECT_EQ(map.one_way_at({5, 50}, north), 1);
  EXPECT_EQ(map.one_way_at({-14, 50}, -north), -1);
  EXPECT_EQ(map.one_way_at({5, 50}, east), 0) << "across the street";
  EXPECT_EQ(map.one_way_at({16, 50}, north), 0) << "too far away";
  EXPECT_EQ(map.one_way_at({5000, 50}, north), 0);
  EXPECT_EQ(SdMap().one_way_at({5, 50}, north), 0);
}

TEST(SdMap, AStreetTellsHowManyLanesItHas) {
  const Eigen::Vector2d north = Eigen::Vector2d::UnitY(), east = Eigen::Vector2d::UnitX();
  std::vector<SdWay> ways = crossing_streets();
  EXPECT_EQ(SdMap(ways, {}).lanes_at({5, 50}, north), 0);
  ways[1].lanes = 2;
  const SdMap map(ways, {});
  EXPECT_EQ(map.lanes_at({5, 50}, north), 2);
  EXPECT_EQ(map.lanes_at({-14, 50}, -north), 2);
  EXPECT_EQ(map.lanes_at({5, 50}, east), 0) << "across the street";
  EXPECT_EQ(map.lanes_at({16, 50}, north), 0) << "too far away";
}

TEST(SdMap, StreetsThatLieTogetherTellTheNumberOfLanesThatAllHave) {
  const auto lanes_beside = [](int other, bool either_way) {
    SdWay first{.id = 1, .nodes = {1, 2}, .points = {{-100, 0}, {100, 0}}, .oneway = true, .lanes = 2};
    SdWay second{.id = 2, .nodes = {3, 4}, .points = {{-100, 10}, {100, 10}}, .oneway = true, .lanes = other};
    if (either_way) std::ranges::reverse(second.points);
    const SdMap map({first, second}, {});
    return map.lanes_at({0, 4}, Eigen::Vector2d::UnitX());
  };
  EXPECT_EQ(lanes_beside(2, false), 2);
  EXPECT_EQ(lanes_beside(1, false), 0);
  EXPECT_EQ(lanes_beside(0, false), 0) << "the number of the other one is not known";
  EXPECT_EQ(lanes_beside(2, true), 0) << "carriageways of one road";
}

TEST(SdMap, StreetsOfBothDirectionsSideBySideTellNothing) {
  const Eigen::Vector2d east = Eigen::Vector2d::UnitX();
  const SdMap map({{.id = 1, .nodes = {1, 2}, .points = {{-100, 0}, {100, 0}}, .oneway = true},
                   {.id = 2, .nodes = {3, 4}, .points = {{100, 20}, {-100, 20}}, .oneway = true}},
                  {});
  EXPECT_EQ(map.one_way_at({0, 10}, east), 0);
  EXPECT_EQ(map.one_way_at({0, 2}, east), 1);
  EXPECT_EQ(map.one_way_at({0, 18}, east), -1);
}

TEST(SdMap, TellsThePlaceOnTheStreetBesideAPlace) {
  const SdMap map(crossing_streets(), {});
  const auto east = map.beside({30, -3}, Eigen::Vector2d::UnitX());
  ASSERT_TRUE(east);
  EXPECT_EQ(east->point, Eigen::Vector2d(30, 0));
  EXPECT_EQ(east->direction, Eigen::Vector2d(1, 0));
  EXPECT_EQ(map.beside({30, -3}, -Eigen::Vector2d::UnitX())->direction, Eigen::Vector2d(-1, 0));
  EXPECT_FALSE(map.beside({30, -3}, Eigen::Vector2d::UnitY())) << "across the street";
  EXPECT_FALSE(map.beside({30, -16}, Eigen::Vector2d::UnitX())) << "too far away";
}

TEST(SdMap, AStreetLeadsOnwardStraightAcrossAJunction) {
  const SdMap map(crossing_streets(), {});
  EXPECT_THAT(map.onward({-30, -3}, Eigen::Vector2d::UnitX(), 50.0),
              ElementsAre(Point(-30, 0, 0), Point(0, 0, 0), Point(20, 0, 0)));
  EXPECT_THAT(map.onward({80, -3}, Eigen::Vector2d::UnitX(), 50.0),
              ElementsAre(Point(80, 0, 0), Point(100, 0, 0)))
      << "to its end";
  EXPECT_THAT(map.onward({-3, 30}, -Eigen::Vector2d::UnitY(), 50.0),
              ElementsAre(Point(0, 30, 0), Point(0, 0, 0)))
      << "to the junction: none leads straight on";
}

TEST(SdMap, AStreetLeadsOnwardRoundACornerButNotWhereItForks) {
  std::vector<SdWay> ways = crossing_streets();
  ways[0] = {.id = 1, .nodes = {10, 11}, .points = {{-100, 0}, {0, 0}}};
  EXPECT_EQ(SdMap(ways, {}).onward({-30, -3}, Eigen::Vector2d::UnitX(), 50.0).back(), Point(0, 20, 0));
  ways[1].points[1] = {100, 30};
  ways.push_back({.id = 3, .nodes = {11, 14}, .points = {{0, 0}, {100, -30}}});
  EXPECT_EQ(SdMap(ways, {}).onward({-30, -3}, Eigen::Vector2d::UnitX(), 50.0).back(), Point(0, 0, 0));
  EXPECT_TRUE(SdMap().onward({-30, -3}, Eigen::Vector2d::UnitX(), 50.0).empty());
}

TEST(SdMap, WaysNeedTheirPoints) {
  EXPECT_THROW(SdMap({{.id = 1, .nodes = {1, 2}, .points = {{0, 0}}}}, {}), std::invalid_argument);
  EXPECT_THROW(SdMap({{.id = 1, .nodes = {1}, .points = {{0, 0}}}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace laneloom
