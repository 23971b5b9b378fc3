#include "laneloom/lane_graph.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using test::lane;
using test::straight;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Turn = Linkage::Turn;

Linkage link(ElementId from, ElementId to, Turn turn, double probability = 1.0) {
  return {.from = from, .to = to, .turn = turn, .probability = probability, .path = {}};
}

/// Lane 1 leads east to a crossing; lane 2 goes on, lane 3 turns off to the left, lane 5 goes on behind
/// lane 2. Lane 4 lies on the left of lane 1, lane 6 on a bridge over it.
LocalMap crossing() {
  LocalMap map;
  map.lanes = {lane(1, straight({0, 0, 0}, {20, 0, 0})),   lane(2, straight({30, 0, 0}, {50, 0, 0})),
               lane(3, straight({25, 5, 0}, {25, 25, 0})), lane(4, straight({0, 3.5, 0}, {20, 3.5, 0})),
               lane(5, straight({50, 0, 0}, {90, 0, 0})),  lane(6, straight({10, -20, 6}, {10, 20, 6}))};
  map.lanes[0].left_neighbours = {{.lane = 4, .range = {5.0, 20.0}}};
  map.linkages = {link(1, 2, Turn::straight), link(1, 3, Turn::left), link(2, 5, Turn::unknown)};
  return map;
}

std::vector<ElementId> ids(const std::vector<Passage>& passages) {
  std::vector<ElementId> result;
  for (const Passage& passage : passages) result.push_back(passage.to.lane->id);
  return result;
}

TEST(LaneGraph, FindsLanesByTheirIds) {
  const LocalMap map = crossing();
  const LaneGraph graph(map);
  EXPECT_EQ(graph.find(3), &map.lanes[2]);
  EXPECT_EQ(graph.find(7), nullptr);
}

TEST(LaneGraph, TheVehicleIsInTheLaneThatItRunsAlong) {
  const LocalMap map = crossing();
  const LaneGraph graph(map);
  const auto own = graph.own_lane(test::at(8, 0.5));
  ASSERT_TRUE(own);
  EXPECT_EQ(own->lane.lane->id, 1U);
  EXPECT_FALSE(own->lane.against);
  EXPECT_NEAR(own->arc_m, 8.0, 1e-9);
  EXPECT_NEAR(own->offset_m, 0.5, 1e-9);
  const auto back = graph.own_lane(test::at(8, 0.5, std::numbers::pi));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->lane.against);
  EXPECT_NEAR(back->arc_m, 12.0, 1e-9);
  EXPECT_NEAR(back->offset_m, -0.5, 1e-9);
  EXPECT_FALSE(graph.own_lane(test::at(8, 0.5, std::numbers::pi / 2))) << "across";
  EXPECT_FALSE(graph.own_lane(test::at(8, -2.0))) << "beside";
  EXPECT_FALSE(graph.own_lane(test::at(-1, 0))) << "before it begins";
}

TEST(LaneGraph, APlaceIsInTheLaneOnItsLevel) {
  const LocalMap map = crossing();
  const LaneGraph graph(map);
  EXPECT_EQ(graph.at({10, 0.2, 0})->id, 1U);
  EXPECT_EQ(graph.at({10, 0.2, 6})->id, 6U);
  EXPECT_EQ(graph.at({10, -8, 0}), nullptr);
}

TEST(LaneGraph, SuccessorsAreThoseOfTheSenseInWhichALaneIsWalked) {
  const LocalMap map = crossing();
  const LaneGraph graph(map);
  EXPECT_THAT(ids(graph.successors({graph.find(1), false})), ElementsAre(2, 3));
  EXPECT_THAT(graph.successors({graph.find(1), true}), IsEmpty());
  const auto back = graph.successors({graph.find(3), true});
  ASSERT_THAT(ids(back), ElementsAre(1));
  EXPECT_TRUE(back[0].to.against);
  EXPECT_EQ(back[0].turn, Turn::right);
  EXPECT_EQ(graph.successors({graph.find(2), false})[0].turn, Turn::straight) << "told from the lanes";
}

TEST(LaneGraph, LeavesOutLinkagesToLanesThatAreNotThere) {
  LocalMap map = crossing();
  map.lanes.erase(map.lanes.begin() + 1);
  const LaneGraph graph(map);
  EXPECT_THAT(ids(graph.successors({graph.find(1), false})), ElementsAre(3));
}

TEST(LaneGraph, AheadLiesTheWishedTurnAndWhatFollowsStraightOn) {
  const LocalMap map = crossing();
  const LaneGraph graph(map);
  const DirectedLane first{graph.find(1), false};
  EXPECT_THAT(ids(graph.ahead(first, Turn::straight, 100.0)), ElementsAre(2, 5));
  EXPECT_THAT(ids(graph.ahead(first, Turn::straight, 30.0)), ElementsAre(2));
  EXPECT_THAT(ids(graph.ahead(first, Turn::left, 100.0)), ElementsAre(3));
  EXPECT_THAT(ids(graph.ahead(first, Turn::right, 100.0)), ElementsAre(2, 5)) << "there is none";
  EXPECT_THAT(graph.ahead(first, Turn::left, 10.0), IsEmpty());
}

TEST(LaneGraph, AheadEndsOnARing) {
  LocalMap map = crossing();
  map.linkages.push_back(link(5, 1, Turn::straight));
  const LaneGraph graph(map);
  EXPECT_THAT(ids(graph.ahead({graph.find(1), false}, Turn::straight, 1e6)), ElementsAre(2, 5));
}

TEST(LaneGraph, OfEqualPassagesTheLikelierLeadsOn) {
  LocalMap map = crossing();
  map.linkages = {link(1, 3, Turn::straight, 0.4), link(1, 2, Turn::straight, 0.9)};
  const LaneGraph graph(map);
  EXPECT_THAT(ids(graph.ahead({graph.find(1), false}, Turn::straight, 40.0)), ElementsAre(2));
  map.lanes[1].direction = Lane::Direction::against_centerline;
  EXPECT_THAT(ids(graph.ahead({graph.find(1), false}, Turn::straight, 40.0)), ElementsAre(3)) << "oncoming";
}

TEST(LaneGraph, BesideIsWhatLiesThereAtThatPlace) {
  const LocalMap map = crossing();
  const LaneGraph graph(map);
  const Lane* own = graph.find(1);
  EXPECT_EQ(graph.beside({own, false}, Side::left, 10.0), graph.find(4));
  EXPECT_EQ(graph.beside({own, false}, Side::left, 2.0), nullptr);
  EXPECT_EQ(graph.beside({own, false}, Side::right, 10.0), nullptr);
  EXPECT_EQ(graph.beside({own, true}, Side::right, 10.0), graph.find(4));
  EXPECT_EQ(graph.beside({own, true}, Side::right, 18.0), nullptr);
}

TEST(TurnBetween, TellsTurnsByTheAngle) {
  const auto turn = [](double angle_deg) {
    const double angle_rad = angle_deg * std::numbers::pi / 180.0;
    return turn_between(Eigen::Vector2d(1, 0), Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
  };
  EXPECT_EQ(turn(0), Turn::straight);
  EXPECT_EQ(turn(45), Turn::straight);
  EXPECT_EQ(turn(55), Turn::left);
  EXPECT_EQ(turn(125), Turn::left);
  EXPECT_EQ(turn(-90), Turn::right);
  EXPECT_EQ(turn(135), Turn::u_turn);
  EXPECT_EQ(turn(-135), Turn::u_turn);
  EXPECT_EQ(turn(170), Turn::u_turn);
}

TEST(TurnBetween, LanesWithoutADirectionGoStraightOn) {
  EXPECT_EQ(turn_between(Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 0)), Turn::straight);
}

TEST(LaneGraph, AShoulderIsTheOwnLaneOnlyWhereTheVehicleIsInNothingElse) {
  LocalMap map;
  map.lanes = {lane(1, straight({0, 0, 0}, {20, 0, 0})), lane(2, straight({0, 0.5, 0}, {20, 1, 0}))};
  map.lanes[0].use = Lane::Use::shoulder;
  EXPECT_EQ(LaneGraph(map).own_lane(test::at(8))->lane.lane->id, 2U);
  map.lanes.pop_back();
  EXPECT_EQ(LaneGraph(map).own_lane(test::at(8))->lane.lane->id, 1U);
}

TEST(LaneGraph, TheWayAheadLeadsOntoNoShoulder) {
  LocalMap map = crossing();
  const LaneGraph graph(map);
  EXPECT_THAT(ids(graph.ahead({&map.lanes[0], false}, Turn::straight, 100.0)), ElementsAre(2, 5));
  map.lanes[4].use = Lane::Use::shoulder;
  EXPECT_THAT(ids(graph.ahead({&map.lanes[0], false}, Turn::straight, 100.0)), ElementsAre(2));
}

TEST(LaneGraph, TrafficMayRunAgainstALaneThatIsDrivenBothWays) {
  Lane both = lane(1, straight({0, 0, 0}, {20, 0, 0}));
  both.direction = Lane::Direction::both;
  EXPECT_TRUE((DirectedLane{&both, false}.oncoming()));
  EXPECT_TRUE((DirectedLane{&both, true}.oncoming()));
}

TEST(Lane, TheBorderBesideAnArcLengthIsTheOneThatCoversIt) {
  Lane lane;
  lane.left_borders = {{7, {0, 10}, {}}, {kNoElement, {10, 15}, {}}, {8, {15, 20}, {}}};
  EXPECT_EQ(lane.border_at(Side::left, 0.0)->boundary, 7U);
  EXPECT_EQ(lane.border_at(Side::left, 9.0)->boundary, 7U);
  EXPECT_EQ(lane.border_at(Side::left, 12.0), nullptr) << "unseen";
  EXPECT_EQ(lane.border_at(Side::left, 20.0)->boundary, 8U);
  EXPECT_EQ(lane.border_at(Side::left, 21.0), nullptr);
  EXPECT_EQ(lane.border_at(Side::right, 5.0), nullptr);
}

}  // namespace
}  // namespace laneloom::lanes
