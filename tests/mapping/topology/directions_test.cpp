#include "mapping/topology/directions.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/topology/two_lanes.hpp"

namespace laneloom::topology {
namespace {

using test::straight;
using Direction = Lane::Direction;

TEST_F(Directions, OnASolidLineTrafficMeetsOnTheDrivingSide) {
  divider(MarkingStyle::solid);
  find();
  EXPECT_TRUE(known(11) && known(12));
  EXPECT_FALSE(runs_forward(11));
  EXPECT_TRUE(runs_forward(12));
  // The turned lane's sides are its own; both see the other across their left side.
  EXPECT_EQ(get(11).left_borders.front().boundary, 2U);
  EXPECT_EQ(lanes::main_neighbour(get(11), Side::left), 12U);
  EXPECT_TRUE(get(11).right_neighbours.empty());
  EXPECT_LT(MeasuredPolyline(get(11).left).project(get(11).right.front()).lateral_m, 0.0);
  EXPECT_EQ(lanes::main_neighbour(get(12), Side::left), 11U);
}

TEST_F(Directions, ADirectionHasAProbabilityAndEvidence) {
  lanes_[0].evidence = Evidence::edges;
  lanes_[1].evidence = Evidence::markings;
  find(DrivingSide::unknown);
  EXPECT_EQ(get(12).direction_probability, -1.0) << "it is unknown";
  EXPECT_EQ(get(12).direction_evidence, Evidence::none);
  double before = 0.5;
  for (const int frames : {4, 6}) {
    for (int i = 0; i < frames; ++i) observe(test::at(10, 1.75));
    find(DrivingSide::unknown);
    EXPECT_GT(get(12).direction_probability, before) << "the more frames, the surer";
    EXPECT_LT(get(12).direction_probability, 1.0);
    before = get(12).direction_probability;
  }
  EXPECT_EQ(get(12).direction_evidence, Evidence::ego_path);
  EXPECT_EQ(get(12).evidence, Evidence::markings | Evidence::ego_path);
  EXPECT_EQ(get(11).evidence, Evidence::edges) << "it was not driven";
}

TEST_F(Directions, ADirectionIsToldUntilItIsInDoubt) {
  tracks_ = lanes::LaneTracks({{.id = 11, .published = 1}, {.id = 12, .published = 1}});
  for (lanes::LaneTrack* lane : {tracks_.find(11), tracks_.find(12)}) lane->belief = 1.0;
  find(DrivingSide::unknown);
  EXPECT_FALSE(known(11) || known(12)) << "1 is less than it takes to begin";
  for (lanes::LaneTrack* lane : {tracks_.find(11), tracks_.find(12)}) {
    lane->belief = 1.0;
    lane->told_direction = 1;
  }
  find(DrivingSide::unknown);
  EXPECT_TRUE(known(11) && known(12));
  for (lanes::LaneTrack* lane : {tracks_.find(11), tracks_.find(12)}) lane->belief = 0.5;
  for (Lane& lane : lanes_) lane.direction = Direction::unknown;
  find(DrivingSide::unknown);
  EXPECT_FALSE(known(11) || known(12));
}

TEST_F(Directions, WhileTheirDirectionIsUnknownLanesRunAsTheyDidBefore) {
  tracks_ = lanes::LaneTracks({{.id = 11, .published = -1}});
  find(DrivingSide::unknown);
  EXPECT_FALSE(known(11) || known(12));
  EXPECT_FALSE(runs_forward(11));
  EXPECT_TRUE(runs_forward(12));
}

TEST_F(Directions, InLeftHandTrafficTheOtherWayRound) {
  divider(MarkingStyle::solid);
  find(DrivingSide::left);
  EXPECT_TRUE(known(11) && known(12));
  EXPECT_TRUE(runs_forward(11));
  EXPECT_FALSE(runs_forward(12));
}

TEST_F(Directions, ADoubleLineIsOne) {
  double_divider();
  divider(MarkingStyle::solid);
  find();
  EXPECT_TRUE(known(11) && known(12));
  EXPECT_FALSE(runs_forward(11));
  EXPECT_TRUE(runs_forward(12));
}

TEST_F(Directions, AMedianDividesThem) {
  for (const double width_m : {1.0, 5.0, 15.0}) {
    median(width_m);
    observe(test::at(20, 1.75));
    find();
    EXPECT_TRUE(known(11)) << width_m;
    EXPECT_FALSE(runs_forward(11)) << width_m;
    EXPECT_TRUE(runs_forward(12)) << width_m;
  }
}

TEST_F(Directions, LinesThatDivergeAreNoMedian) {
  median(1.0);
  for (Polyline* line : {&lanes_[0].left, &lanes_[0].right, &lanes_[0].centerline}) line->back().y() += 3.0;
  boundaries_[0].marking.styles.clear();
  boundaries_[0].marking.type = MarkingType::laneline;
  observe(test::at(20, 1.75));
  find();
  EXPECT_FALSE(known(11));
}

TEST_F(Directions, ToTheRightOfAWideMedianThereMayBeAnotherRoad) {
  median(5.0);
  boundaries_[2].marking.type = MarkingType::laneline;
  for (int frame = 0; frame < 12; ++frame) observe(test::at(20, 10.25));
  find();
  EXPECT_TRUE(known(11) && runs_forward(11));
  EXPECT_FALSE(known(12));
}

TEST_F(Directions, WhatWasSureStaysKnownUntilItIsContradicted) {
  for (int frame = 0; frame < 12; ++frame) observe(test::at(20, 5.25));
  find();
  ASSERT_TRUE(known(12) && runs_forward(12));
  for (const ElementId id : {11U, 12U}) tracks_.find(id)->published = tracks_.find(id)->told_direction = 1;
  // Now alone, between a line and nothing that tells.
  lanes_ = {lane(12, 2, 0, 40)};
  boundaries_[2].marking.type = MarkingType::laneline;
  find();
  EXPECT_TRUE(known(12) && runs_forward(12));
  for (int frame = 0; frame < 200 && runs_forward(12); ++frame) {
    observe(test::at(20, 1.75, std::numbers::pi));
    find();
  }
  EXPECT_TRUE(known(12));
  EXPECT_FALSE(runs_forward(12));
}

TEST_F(Directions, OfThreeLanesASolidLineDoesNotTellWhichOneIsAlone) {
  divider(MarkingStyle::solid);
  boundaries_.push_back(test::boundary(4, straight({0, -3.5, 0}, {40, -3.5, 0}), MarkingType::roadedge));
  boundaries_[2].marking.type = MarkingType::laneline;
  boundaries_[2].marking.styles = {{{0, 40}, MarkingStyle::dashed}};
  lanes_.push_back(lane(13, 3, 0, 40));
  lanes_[1].right_neighbours = {{.lane = 13, .range = {0.0, 40.0}}};
  lanes_[2].left_neighbours = {{.lane = 12, .range = {0.0, 40.0}}};
  find();
  EXPECT_FALSE(known(12));
}

TEST_F(Directions, ALineOnABridgeMakesNoDoubleLineWithOneBelow) {
  double_divider();
  divider(MarkingStyle::solid);
  for (Polyline* line : {&lanes_[1].left, &lanes_[1].right, &lanes_[1].centerline})
    for (Point& point : *line) point.z() = 6.0;
  find();
  EXPECT_FALSE(known(11));
}

TEST_F(Directions, ADashedLineDoesNotTell) {
  divider(MarkingStyle::dashed);
  find();
  EXPECT_FALSE(known(11) || known(12));
  EXPECT_TRUE(runs_forward(11) && runs_forward(12));
}

TEST_F(Directions, WithoutALineTrafficMeetsOnARoadOfTwoWays) {
  boundaries_[1].marking.status = ElementStatus::inferred;
  boundaries_[1].two_way = true;
  find();
  EXPECT_TRUE(known(11));
  EXPECT_TRUE(known(12));
  EXPECT_FALSE(runs_forward(11));
  EXPECT_TRUE(runs_forward(12));
}

TEST_F(Directions, WithoutALineTrafficBesideALineRunsAlike) {
  boundaries_[0].marking.type = MarkingType::laneline;
  boundaries_[1].marking.status = ElementStatus::inferred;
  observe(test::at(20, 5.25));
  observe(test::at(20, 5.25));
  observe(test::at(20, 5.25));
  find();
  EXPECT_TRUE(known(11));
  EXPECT_TRUE(runs_forward(11));
  EXPECT_TRUE(runs_forward(12));
}

TEST_F(Directions, ASolidLineAtTheSideSpeaksAsAnEdgeDoesButLess) {
  for (const std::size_t side : {0U, 2U}) {
    boundaries_[side].marking.type = MarkingType::laneline;
    boundaries_[side].marking.styles = {{{0, 40}, MarkingStyle::solid}};
  }
  // With one frame's driving in it, an edge would do.
  const std::vector<Lane> lanes = lanes_;
  observe(test::at(20, 1.75));
  find();
  EXPECT_FALSE(known(12));
  divider(MarkingStyle::solid);
  lanes_ = lanes;
  tracks_ = {};
  find();
  EXPECT_TRUE(known(11) && known(12));
  EXPECT_FALSE(runs_forward(11));
  EXPECT_TRUE(runs_forward(12));
}

TEST_F(Directions, AnEdgeWithOneFramesDrivingIsEnough) {
  boundaries_[0].marking.type = MarkingType::laneline;
  observe(test::at(20, 1.75));
  find();
  EXPECT_TRUE(known(12));
}

TEST_F(Directions, AHalfOfADoubleLineIsNoSideOfTheRoad) {
  double_divider();
  for (boundaries::LaneBoundary& b : boundaries_) {
    b.marking.type = MarkingType::laneline;
    b.marking.styles = {{{0, 40}, MarkingStyle::solid}};
  }
  find();
  EXPECT_TRUE(known(11) && known(12));
  EXPECT_FALSE(runs_forward(11));
  EXPECT_TRUE(runs_forward(12));
}

TEST_F(Directions, ADashedOrAnInferredLineAtTheSideDoesNotTell) {
  divider(MarkingStyle::solid);
  for (const std::size_t side : {0U, 2U}) boundaries_[side].marking.type = MarkingType::laneline;
  boundaries_[0].marking.styles = {{{0, 40}, MarkingStyle::solid}};
  boundaries_[0].marking.status = ElementStatus::inferred;
  boundaries_[2].marking.styles = {{{0, 40}, MarkingStyle::dashed}};
  find();
  EXPECT_FALSE(known(11) || known(12));
}

TEST_F(Directions, WithoutADrivingSideOnlyObservationsTell) {
  divider(MarkingStyle::solid);
  find(DrivingSide::unknown);
  EXPECT_FALSE(known(11) || known(12));
}

TEST_F(Directions, TheVehicleDrivesWithTheTraffic) {
  divider(MarkingStyle::dashed);
  for (int i = 0; i < 5; ++i) observe(test::at(i, 1.75));
  find();
  EXPECT_TRUE(known(12));
  EXPECT_TRUE(runs_forward(12));
  EXPECT_FALSE(known(11));  // overtaking lane, or oncoming traffic
}

TEST_F(Directions, RightOfALaneAlongTheRoadEveryLaneRunsAlong) {
  divider(MarkingStyle::dashed);
  for (int i = 0; i < 5; ++i) observe(test::at(i, 5.25));
  find();
  EXPECT_TRUE(known(11) && known(12));
  EXPECT_TRUE(runs_forward(11) && runs_forward(12));
}

TEST_F(Directions, AStoplineStopsTheTrafficThatComesToIt) {
  divider(MarkingStyle::dashed);
  const auto stopline = test::marking(9, {{0.5, 3.6, 0}, {0.5, 6.9, 0}}, MarkingType::stopline);
  for (int i = 0; i < 8; ++i) observe(test::at(20, 30), {stopline});
  find();
  EXPECT_TRUE(known(11));
  EXPECT_FALSE(runs_forward(11));
}

TEST_F(Directions, AStandingVehicleSaysNoMoreThanAPassingOne) {
  divider(MarkingStyle::dashed);
  for (int i = 0; i < 10000; ++i) observe(test::at(3, 1.75));
  for (int i = 0; i < 30; ++i) observe(test::at(3, 1.75, std::numbers::pi));
  find();
  EXPECT_FALSE(runs_forward(12));
}

TEST_F(Directions, TheOncomingLaneThatWasOvertakenInIsNotTakenForOurs) {
  divider(MarkingStyle::solid);
  for (int i = 0; i < 30; ++i) observe(test::at(3, 5.25));
  find();
  EXPECT_TRUE(runs_forward(11));
  for (int i = 0; i < 300; ++i) observe(test::at(3, 1.75));
  lanes_[0].direction = Direction::unknown;
  find();
  EXPECT_FALSE(known(11) && runs_forward(11));
}

TEST_F(Directions, CrossingTheLaneOnTheWayIntoAnotherRoadSaysNothing) {
  for (int i = 0; i < 10; ++i) observe(test::at(10, 1.75, 35.0 * std::numbers::pi / 180.0));
  find(DrivingSide::unknown);
  EXPECT_FALSE(known(12));
  for (int i = 0; i < 10; ++i) observe(test::at(10, 1.75, 10.0 * std::numbers::pi / 180.0));
  find(DrivingSide::unknown);
  EXPECT_TRUE(known(12));
}

TEST_F(Directions, BesideABorderTheVehicleMayDriveInALaneThatIsNotKnown) {
  // An inferred border may lie where the vehicle drives, and the lane beside it is the oncoming one.
  const std::vector<Lane> both = lanes_;
  lanes_ = {both[1]};
  lanes_[0].left_neighbours.clear();
  for (int i = 0; i < 10; ++i) observe(test::at(10, 3.3));
  find(DrivingSide::unknown);
  EXPECT_FALSE(known(12));
  lanes_ = both;
  for (int i = 0; i < 10; ++i) observe(test::at(10, 3.3));
  find(DrivingSide::unknown);
  EXPECT_TRUE(known(12)) << "no lane is unknown there";
}

TEST_F(Directions, AFrameThatContradictsABeliefAndSaysMoreIsFollowedAtOnce) {
  lanes_ = {lane(12, 2, 0, 40)};
  tracks_ = lanes::LaneTracks({{.id = 12, .published = 1, .belief = 2.0, .told_direction = 1}});
  int frames = 0;
  for (; frames < 20 && runs_forward(12); ++frames) {
    observe(test::at(20, 1.75, std::numbers::pi));
    find(DrivingSide::unknown);
  }
  EXPECT_LE(frames, 9) << "the vehicle drives against it";
}

TEST_F(Directions, CrossingTheLaneSaysNothing) {
  divider(MarkingStyle::dashed);
  for (int i = 0; i < 10; ++i) observe(test::at(3, 1.75, 0.5 * std::numbers::pi));
  find();
  EXPECT_FALSE(known(12));
}

TEST_F(Directions, LanesAlongTheSameSideOfABoundaryRunTheSameWay) {
  lanes_ = {lane(12, 2, 0, 10), lane(13, 2, 30, 40)};  // along the edge, on both sides of an intersection
  observe(test::at(5, 1.75));
  find(DrivingSide::unknown);
  EXPECT_TRUE(known(12) || !known(13));
  for (int i = 0; i < 5; ++i) observe(test::at(5, 1.75));
  find(DrivingSide::unknown);
  EXPECT_TRUE(known(12) && known(13));
  EXPECT_TRUE(runs_forward(13));
}

TEST_F(Directions, BesideTheBoundaryOfTheOncomingLaneALaneForTurningMayOpen) {
  // Lane 13 opens at x = 20 between boundary 2 and lane 11, which lay beside boundary 2 before.
  lanes_[0].right_borders = {{2, {0.0, 20.0}, {0.0, 20.0}}, {4, {20.0, 40.0}, {20.0, 40.0}}};
  lanes_.push_back(lane(13, 1, 20, 40));
  lanes_.back().left_borders.front().boundary = 4;
  lanes_.back().right_borders = {{2, {0.0, 20.0}, {20.0, 40.0}}};
  lanes_[0].right_neighbours = {{.lane = 13, .range = {20.0, 40.0}}};
  lanes_.back().left_neighbours = {{.lane = 11, .range = {0.0, 20.0}}};
  boundaries_.push_back(test::boundary(4, straight({20, 5.25, 0}, {40, 5.25, 0})));
  driven_ = {{.trail = 0, .lane = 2, .along_m = 20.0}};
  find(DrivingSide::unknown);
  EXPECT_TRUE(known(13));
  EXPECT_FALSE(known(11)) << "it may be the oncoming lane";
}

TEST_F(Directions, ALaneThatRunsAgainstOthersBesideItsBoundaryIsTurned) {
  // The second stretch of the left lane was built against its boundaries.
  lanes_ = {lane(11, 1, 0, 20), lane(13, 1, 20, 40)};
  Lane& turned = lanes_[1];
  for (Polyline* line : {&turned.left, &turned.right, &turned.centerline}) std::ranges::reverse(*line);
  std::swap(turned.left, turned.right);
  std::swap(turned.left_borders.front().boundary, turned.right_borders.front().boundary);
  turned.left_borders.front().reversed = turned.right_borders.front().reversed = true;
  for (int i = 0; i < 5; ++i) observe(test::at(10, 5.25));
  find(DrivingSide::unknown);
  EXPECT_TRUE(known(11) && known(13));
  EXPECT_TRUE(runs_forward(11) && runs_forward(13));
  EXPECT_EQ(get(13).left_borders.front().boundary, 1U);
  EXPECT_EQ(get(13).left_borders.front().on_boundary.from_m, 20.0);
  EXPECT_FALSE(get(13).left_borders.front().reversed || get(13).right_borders.front().reversed);
}

TEST_F(Directions, AWayIsTurnedWithItsLanes) {
  lanes_ = {lane(11, 1, 0, 10), lane(12, 1, 20, 40)};
  linkages_ = {{.from = 11, .to = 12, .path = {{10, 5.25, 0}, {20, 5.25, 0}}}};
  for (int i = 0; i < 5; ++i) observe(test::at(5, 5.25, std::numbers::pi));
  find(DrivingSide::unknown);
  ASSERT_FALSE(runs_forward(11));
  EXPECT_EQ(linkages_[0].from, 12U);
  EXPECT_EQ(linkages_[0].path.front().x(), 20.0);
}

TEST_F(Directions, ALeftTurnThatIsDrivenTheOtherWayIsARightTurn) {
  RoadGraph road{{{}, lanes_}, {{.from = 11, .to = 12, .turn = Linkage::Turn::left}}};
  road.turn({11, 12});
  ASSERT_EQ(road.linkages.size(), 1U);
  EXPECT_EQ(road.linkages[0].from, 12U);
  EXPECT_EQ(road.linkages[0].turn, Linkage::Turn::right);
}

TEST_F(Directions, NoWayLeadsFromATurnedLaneIntoOneThatIsNot) {
  RoadGraph road{{{}, lanes_}, {{.from = 11, .to = 12}, {.from = 12, .to = 11}}};
  road.turn({11});
  EXPECT_TRUE(road.linkages.empty());
}

TEST_F(Directions, LanesThatContinueOneAnotherRunTheSameWay) {
  lanes_ = {lane(11, 1, 0, 20), lane(13, 1, 20, 40)};
  linkages_ = {{.from = 11, .to = 13}};
  for (int i = 0; i < 5; ++i) observe(test::at(30.0 + i, 5.25, std::numbers::pi));
  find();
  EXPECT_TRUE(known(11) && known(13));
  EXPECT_FALSE(runs_forward(11) || runs_forward(13));
  EXPECT_EQ(linkages_[0].from, 13U);
  EXPECT_EQ(linkages_[0].to, 11U);
}

}  // namespace
}  // namespace laneloom::topology
