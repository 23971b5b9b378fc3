#include "evaluation/linkages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "evaluation/map_evaluation.hpp"

namespace laneloom {
namespace {

using testing::ElementsAre;
using testing::Pair;

simulation::RoadLane truth_lane(ElementId id, Polyline centerline, std::vector<ElementId> successors,
                                ElementId marking = 1) {
  return {.id = id,
          .centerline = std::move(centerline),
          .left_marking = marking,
          .right_marking = marking,
          .successors = std::move(successors)};
}

/// Lane 1 splits into 2 (straight on) and 3 (beside it); 4 follows 2 across the unpainted 9.
simulation::Road forking_road() {
  simulation::Road road;
  road.lanes = {truth_lane(1, {{-5, 0, 0}, {5, 0, 0}}, {2, 3}), truth_lane(2, {{5, 0, 0}, {15, 0, 0}}, {9}),
                truth_lane(3, {{5, 1, 0}, {15, 4, 0}}, {}),
                truth_lane(9, {{15, 0, 0}, {20, 0, 0}}, {4}, kNoElement),
                truth_lane(4, {{20, 0, 0}, {30, 0, 0}}, {})};
  road.markings = {{1, MarkingType::stopline, MarkingStyle::solid, {{16, -1.5, 0}, {16, 1.5, 0}}}};
  return road;
}

Lane lane(ElementId id, Polyline centerline) {
  Lane result;
  result.id = id;
  result.centerline = std::move(centerline);
  return result;
}

Linkage linked(ElementId from, ElementId to) {
  Linkage linkage;
  linkage.from = from;
  linkage.to = to;
  return linkage;
}

LocalMap perfect() {
  LocalMap map;
  for (const simulation::RoadLane& truth : forking_road().lanes)
    if (truth.left_marking != kNoElement) map.lanes.push_back(lane(10 + truth.id, truth.centerline));
  map.linkages = {linked(11, 12), linked(11, 13), linked(12, 14)};
  map.linkages[2].path = {{15, 0, 0}, {20, 0, 0}};
  map.linkages[2].kind = Linkage::Kind::intersection;
  Stopline stopline;
  stopline.marking.type = MarkingType::stopline;
  stopline.marking.points = forking_road().markings[0].points;
  stopline.lanes = {12};
  map.stoplines = {stopline};
  return map;
}

evaluation::TopologyScore score(const LocalMap& map) {
  evaluation::MapEvaluation evaluation(forking_road(), RangeConfig{}, evaluation::Subject::maps);
  evaluation.add(map);
  return evaluation.topology();
}

TEST(TruthTopology, LooksAcrossLanesThatNobodySees) {
  // Chains in order of ids: 1, 2, 3, 4.
  const evaluation::TruthTopology topology = evaluation::truth_topology(forking_road());
  EXPECT_THAT(topology.successors, ElementsAre(Pair(0, 1), Pair(0, 2), Pair(1, 3)));
  // The markings' lines come after the four chains; the stopline is 1 m behind the end of lane 2.
  EXPECT_THAT(topology.lanes_of_stopline, ElementsAre(Pair(4, ElementsAre(1))));
}

TEST(Linkages, APerfectMapScoresPerfectly) {
  const evaluation::TopologyScore perfect_score = score(perfect());
  EXPECT_EQ(perfect_score.linkages.truths, 3u);
  EXPECT_EQ(perfect_score.linkages.f1(), 1.0);
  EXPECT_EQ(perfect_score.by_kind[0].precision(), 1.0);
  EXPECT_EQ(perfect_score.stopline_lanes.truths, 1u);
  EXPECT_EQ(perfect_score.stopline_lanes.f1(), 1.0);
}

TEST(Linkages, WrongAndMissingOnesCount) {
  LocalMap map = perfect();
  map.linkages = {linked(11, 12), linked(13, 14)};
  map.linkages[1].kind = Linkage::Kind::intersection;
  const evaluation::TopologyScore wrong = score(map);
  EXPECT_DOUBLE_EQ(wrong.linkages.precision(), 0.5);
  EXPECT_DOUBLE_EQ(wrong.linkages.recall(), 1.0 / 3.0);
  EXPECT_EQ(wrong.by_kind[0].precision(), 1.0);
  EXPECT_EQ(wrong.by_kind[2].published, 1u);
  EXPECT_EQ(wrong.by_kind[2].precision(), 0.0);
}

TEST(Linkages, RecallAsksOnlyForLanesThatWereFound) {
  LocalMap map = perfect();
  std::erase_if(map.lanes, [](const Lane& l) { return l.id == 14; });
  map.linkages.pop_back();
  EXPECT_EQ(score(map).linkages.truths, 2u);
  EXPECT_EQ(score(map).linkages.recall(), 1.0);
}

TEST(Linkages, MayRunAgainstTheTruthWhereTheDirectionIsUnknownOrBoth) {
  LocalMap map = perfect();
  for (Lane& l : map.lanes) std::reverse(l.centerline.begin(), l.centerline.end());
  for (Linkage& linkage : map.linkages) std::swap(linkage.from, linkage.to);
  EXPECT_EQ(score(map).linkages.f1(), 1.0);
  for (const auto direction : {Lane::Direction::against_centerline, Lane::Direction::both}) {
    for (Lane& l : map.lanes) l.direction = direction;
    EXPECT_EQ(score(map).linkages.f1(), 1.0);
  }
  for (Lane& l : map.lanes) l.direction = Lane::Direction::along_centerline;
  EXPECT_EQ(score(map).linkages.precision(), 0.0);
}

TEST(Linkages, PiecesOfOneTruthLaneMayBeLinkedInOrder) {
  LocalMap map;
  map.lanes = {lane(1, {{-5, 0, 0}, {0, 0, 0}}), lane(2, {{0, 0, 0}, {5, 0, 0}})};
  map.linkages = {linked(1, 2), linked(2, 1)};
  const evaluation::PairScore linkages = score(map).linkages;
  EXPECT_EQ(linkages.published, 2u);
  EXPECT_EQ(linkages.right, 1u);
}

TEST(Linkages, AreJudgedByTheEndsThatMeet) {
  LocalMap map = perfect();
  map.lanes[0].centerline = {{0, 0, 0}, {11, 0, 0}};  // as long on truth lane 1 as on 2
  map.lanes[1].centerline = {{11, 0, 0}, {15, 0, 0}};
  map.linkages = {linked(11, 12)};
  EXPECT_EQ(score(map).linkages.precision(), 1.0);
}

TEST(Directions, AreRightWhereLanesRunWithTheTraffic) {
  LocalMap map = perfect();
  EXPECT_EQ(score(map).directions.published, 0u);
  EXPECT_EQ(score(map).directions.truths, 4u);
  for (Lane& l : map.lanes) l.direction = Lane::Direction::along_centerline;
  EXPECT_EQ(score(map).directions.f1(), 1.0);
  map.lanes[0].direction = Lane::Direction::against_centerline;
  map.lanes[1].direction = Lane::Direction::unknown;
  EXPECT_DOUBLE_EQ(score(map).directions.precision(), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(score(map).directions.recall(), 0.5);
}

TEST(Stoplines, NameTheLanesThatTheyEnd) {
  LocalMap map = perfect();
  map.stoplines[0].lanes = {12, 13};
  EXPECT_DOUBLE_EQ(score(map).stopline_lanes.precision(), 0.5);
  EXPECT_DOUBLE_EQ(score(map).stopline_lanes.recall(), 1.0);
  map.stoplines[0].lanes = {};
  EXPECT_DOUBLE_EQ(score(map).stopline_lanes.recall(), 0.0);
}

TEST(FrechetDistance, IsTheLongestLeashOfTheBestWalk) {
  EXPECT_DOUBLE_EQ(evaluation::frechet_distance_m({{0, 0, 0}, {2, 0, 0}}, {{0, 1, 0}, {2, 1, 5}}), 1.0);
  EXPECT_DOUBLE_EQ(evaluation::frechet_distance_m({{0, 0, 0}, {2, 0, 0}}, {{2, 0, 0}, {0, 0, 0}}),
                   2.0);  // the other way
  // Both wait at the corner for each other; the detour's tip is 3 m off.
  EXPECT_DOUBLE_EQ(
      evaluation::frechet_distance_m({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 0, 0}, {1, 3, 0}, {2, 0, 0}}),
      3.0);
}

double top_ll(const LocalMap& map) {
  evaluation::MapEvaluation evaluation(forking_road(), RangeConfig{}, evaluation::Subject::maps);
  evaluation.add(map);
  return evaluation.top_ll().value();
}

TEST(TopLl, APerfectMapScoresPerfectly) { EXPECT_DOUBLE_EQ(top_ll(perfect()), 1.0); }

TEST(TopLl, JoinsLanesThatOnlyContinue) {
  LocalMap map = perfect();
  map.lanes[0].centerline = {{-5, 0, 0}, {0, 0, 0}};
  map.lanes.push_back(lane(20, {{0, 0, 0}, {5, 0, 0}}));
  map.linkages = {linked(11, 20), linked(20, 12), linked(20, 13), linked(12, 14)};
  map.linkages[3].kind = Linkage::Kind::intersection;
  EXPECT_DOUBLE_EQ(top_ll(map), 1.0);
}

TEST(TopLl, LanesOfUnknownDirectionMayTurn) {
  LocalMap map = perfect();
  for (Lane& l : map.lanes) std::reverse(l.centerline.begin(), l.centerline.end());
  for (Linkage& linkage : map.linkages) {
    std::swap(linkage.from, linkage.to);
    linkage.path = {{0, 0, 0}, {1, 0, 0}};
  }
  EXPECT_DOUBLE_EQ(top_ll(map), 1.0);
  for (Lane& l : map.lanes) l.direction = Lane::Direction::against_centerline;
  EXPECT_DOUBLE_EQ(top_ll(map), 1.0);
}

TEST(TopLl, AMissingEdgeCostsBothItsLanes) {
  LocalMap map = perfect();
  map.linkages = {linked(11, 12), linked(12, 14)};
  for (Linkage& linkage : map.linkages) linkage.kind = Linkage::Kind::intersection;
  // Out of 1: one of two, 1/2. Into 3: none of one, 0. The six others are 1.
  EXPECT_DOUBLE_EQ(top_ll(map), 6.5 / 8.0);
}

TEST(TopLl, AWrongEdgeCountsByItsProbability) {
  LocalMap map = perfect();
  map.linkages.push_back(linked(11, 14));
  for (std::size_t i = 0; i < 3; ++i) map.linkages[i].probability = 0.8;
  // Out of 1: the wrong one comes first, (1/2 + 2/3) / 2. Into 4: the wrong one comes first, 1/2. The six
  // others are 1.
  EXPECT_NEAR(top_ll(map), (6.0 + (1.0 / 2 + 2.0 / 3) / 2 + 1.0 / 2) / 8.0, 1e-12);
  map.linkages.back().probability = 0.5;
  EXPECT_DOUBLE_EQ(top_ll(map), 1.0);
}

TEST(TopLl, AMissingLaneTakesItsNeighboursAlong) {
  LocalMap map = perfect();
  std::erase_if(map.lanes, [](const Lane& l) { return l.id == 13; });
  map.linkages = {linked(11, 12), linked(12, 14)};
  for (Linkage& linkage : map.linkages) linkage.kind = Linkage::Kind::intersection;
  // Lane 3's edges are told the wrong way round. Out of: 1 one of two, 1/2; 2 right, then wrong, 1;
  // 3 none exist and three are told, 0; 4 likewise, 0. Into: 1, likewise, 0; 2 and 4 right, then wrong, 1;
  // 3 one exists, others are told, 0. In 3's own row, 3 itself is told, too.
  EXPECT_DOUBLE_EQ(top_ll(map), (0.5 + 1 + 0 + 0 + 0 + 1 + 0 + 1) / 8.0);
}

}  // namespace
}  // namespace laneloom
