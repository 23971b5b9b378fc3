#include "drive/ways.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "maps.hpp"

namespace laneloom::drive {
namespace {

/// Lane 1 comes along x to the origin; straight on is 2, to the left 3, to the right 4.
LocalMap crossing_lanes() {
  LocalMap map;
  map.lanes = {
      lane_of(1, straight_line({-30, 0, 0}, {-10, 0, 0})), lane_of(2, straight_line({10, 0, 0}, {30, 0, 0})),
      lane_of(3, straight_line({0, 10, 0}, {0, 30, 0})), lane_of(4, straight_line({0, -10, 0}, {0, -30, 0}))};
  map.linkages = {link(1, 2, Linkage::Turn::straight), link(1, 3, Linkage::Turn::left),
                  link(1, 4, Linkage::Turn::right)};
  return map;
}

ElementId chosen(const LocalMap& map, Linkage::Turn wanted) {
  const std::vector<Passage> all = passages(LaneGraph(map), {map.lanes.data(), false});
  const Passage* passage = best_passage(all, wanted);
  return passage == nullptr ? kNoElement : passage->to.lane->id;
}

TEST(Ways, TheWantedTurnIsTaken) {
  const LocalMap map = crossing_lanes();
  EXPECT_EQ(chosen(map, Linkage::Turn::straight), 2U);
  EXPECT_EQ(chosen(map, Linkage::Turn::left), 3U);
  EXPECT_EQ(chosen(map, Linkage::Turn::right), 4U);
  EXPECT_EQ(chosen(map, Linkage::Turn::unknown), 2U);
  LocalMap poor = map;
  poor.linkages.resize(1);
  EXPECT_EQ(chosen(poor, Linkage::Turn::left), 2U);  // where the map leads
  poor.linkages.clear();
  EXPECT_EQ(chosen(poor, Linkage::Turn::left), kNoElement);
}

TEST(Ways, TurnsThatTheMapDoesNotNameAreSeenFromTheLanes) {
  LocalMap map = crossing_lanes();
  for (Linkage& linkage : map.linkages) linkage.turn = Linkage::Turn::unknown;
  EXPECT_EQ(chosen(map, Linkage::Turn::straight), 2U);
  EXPECT_EQ(chosen(map, Linkage::Turn::left), 3U);
  EXPECT_EQ(chosen(map, Linkage::Turn::right), 4U);
}

TEST(Ways, AmongEqualsTheLikelierIsTaken) {
  LocalMap map = crossing_lanes();
  map.linkages = {link(1, 3, Linkage::Turn::straight), link(1, 2, Linkage::Turn::straight)};
  map.linkages[0].probability = 0.4;
  map.linkages[1].probability = 0.9;
  EXPECT_EQ(chosen(map, Linkage::Turn::straight), 2U);
}

TEST(Ways, AreWalkedAgainstTheLanesToo) {
  const LocalMap map = crossing_lanes();
  const std::vector<Passage> back =
      passages(LaneGraph(map), {&map.lanes[2], true});  // out of lane 3, southwards
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].to.lane->id, 1U);
  EXPECT_TRUE(back[0].to.against);
  EXPECT_EQ(back[0].turn, Linkage::Turn::right);
  EXPECT_EQ(back[0].to.centerline().front(), Point(-10, 0, 0));
  EXPECT_EQ(back[0].path.front(), Point(0, 10, 0));
}

TEST(Ways, OncomingTrafficIsKnownByTheDirection) {
  Lane lane = lane_of(1, straight_line({0, 0, 0}, {10, 0, 0}));
  EXPECT_FALSE((DirectedLane{&lane, false}.oncoming()));
  lane.direction = Lane::Direction::along_centerline;
  EXPECT_FALSE((DirectedLane{&lane, false}.oncoming()));
  EXPECT_TRUE((DirectedLane{&lane, true}.oncoming()));
  lane.direction = Lane::Direction::against_centerline;
  EXPECT_TRUE((DirectedLane{&lane, false}.oncoming()));
}

/// Lane 1 narrows to 2.5 m and ends at x = 40; lane 2 on its left goes on.
LocalMap ending_lane(std::vector<Stretch> crossable) {
  LocalMap map;
  map.lanes = {lane_of(1, straight_line({0, 0, 0}, {40, 0, 0})),
               lane_of(2, straight_line({0, 3.5, 0}, {80, 3.5, 0}))};
  for (Point& point : map.lanes[0].right) point.y() += point.x() / 40.0;
  map.lanes[0].left_neighbours = {{.lane = 2, .range = {0.0, 40.0}, .crossable = std::move(crossable)}};
  return map;
}

TEST(Ways, ALaneThatEndsLeadsToTheOneBeside) {
  LocalMap map = ending_lane({{0.0, 40.0}});
  const DirectedLane way{map.lanes.data(), false};
  ASSERT_NE(lane_to_change_to(LaneGraph(map), way).lane, nullptr);
  EXPECT_EQ(lane_to_change_to(LaneGraph(map), way).lane->id, 2U);
  map.lanes[1].direction = Lane::Direction::against_centerline;
  EXPECT_EQ(lane_to_change_to(LaneGraph(map), way).lane, nullptr);
}

TEST(Ways, NoneIsChangedToAcrossASolidLineNorWhereOnlyTheViewEnds) {
  for (const auto& crossable : {std::vector<Stretch>{}, std::vector<Stretch>{{0.0, 10.0}}}) {
    const LocalMap solid = ending_lane(crossable);
    EXPECT_EQ(lane_to_change_to(LaneGraph(solid), {solid.lanes.data(), false}).lane, nullptr);
  }
  LocalMap wide = ending_lane({{0.0, 40.0}});
  for (Point& point : wide.lanes[0].right) point.y() = -1.75;
  EXPECT_EQ(lane_to_change_to(LaneGraph(wide), {wide.lanes.data(), false}).lane, nullptr);
}

}  // namespace
}  // namespace laneloom::drive
