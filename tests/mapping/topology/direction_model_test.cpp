#include "mapping/topology/direction_model.hpp"

#include <gmock/gmock.h>

#include "mapping/topology/two_lanes.hpp"

namespace laneloom::topology {
namespace {

/// What traffic and the SD map tell, and what a direction rests on.
TEST_F(Directions, OneTrailTellsTheDirectionOfALane) {
  driven_ = {{.trail = 0, .lane = 0, .along_m = -20.0}};
  find(DrivingSide::unknown);
  EXPECT_TRUE(known(11));
  EXPECT_FALSE(runs_forward(11));
  EXPECT_EQ(get(11).direction_evidence, Evidence::traffic);
  EXPECT_EQ(get(11).evidence, Evidence::traffic);
  EXPECT_FALSE(known(12)) << "nothing tells how the two belong together";
  EXPECT_EQ(get(12).evidence, Evidence::none);
}

TEST_F(Directions, BesideTheOwnWayOneThatOvertakesTellsNothingAndOneThatComesTellsAll) {
  divider(MarkingStyle::dashed);
  for (boundaries::LaneBoundary& boundary : boundaries_) boundary.marking.type = MarkingType::laneline;
  for (int i = 0; i < 10; ++i) observe(test::at(10, 1.75));
  const std::vector<Lane> lanes = lanes_;
  driven_ = {{.trail = 0, .lane = 0, .along_m = 20.0}};
  find();
  EXPECT_FALSE(known(11));
  EXPECT_TRUE(known(12) && runs_forward(12));
  lanes_ = lanes;
  driven_ = {{.trail = 0, .lane = 0, .along_m = -20.0}};
  find();
  EXPECT_TRUE(known(11));
  EXPECT_FALSE(runs_forward(11));
  EXPECT_TRUE(known(12) && runs_forward(12));
}

TEST_F(Directions, EvidenceIsThatOfTheLanesBesideAndOfBefore) {
  divider(MarkingStyle::solid);
  for (Lane& lane : lanes_) lane.evidence = Evidence::markings | Evidence::edges;
  tracks_ = lanes::LaneTracks({{.id = 11, .published = 1}, {.id = 12, .published = 1}});
  const std::vector<Lane> lanes = lanes_;
  const auto frame = [&](DrivingSide driving_side) {
    lanes_ = lanes;
    find(driving_side);
  };
  driven_ = {{.trail = 0, .lane = 0, .along_m = -20.0}};
  for (int i = 0; i < 10; ++i) frame(DrivingSide::right);
  ASSERT_TRUE(known(12));
  EXPECT_EQ(get(12).direction_evidence, Evidence::markings | Evidence::edges | Evidence::traffic)
      << "by the line, the edge and the lane beside";
  driven_.clear();
  frame(DrivingSide::unknown);
  ASSERT_TRUE(known(12));
  EXPECT_TRUE(overlap(get(12).direction_evidence, Evidence::traffic)) << "the belief lasts";
}

TEST_F(Directions, WhereTrafficToldTheSideEvidenceIsTraffic) {
  divider(MarkingStyle::solid);
  for (Lane& lane : lanes_) lane.evidence = Evidence::markings;
  for (const bool corrected : {false, true}) {
    RoadGraph road{{boundaries_, lanes_}, {}};
    lanes::LaneTracks tracks;
    find_directions({}, {.beside = side_by_side(road), .driven = {}, .is_side_corrected = corrected}, tracks,
                    road);
    ASSERT_EQ(road.lanes[1].direction, Lane::Direction::along_centerline);
    EXPECT_EQ(overlap(road.lanes[1].direction_evidence, Evidence::traffic), corrected);
  }
}

TEST_F(Directions, AOneWayStreetTellsTheDirectionsOfItsLanes) {
  find(DrivingSide::unknown);
  ASSERT_FALSE(known(11) || known(12));
  lanes_[0].evidence = lanes_[1].evidence = Evidence::edges;
  one_way_ = {1.0, 1.0};
  find(DrivingSide::unknown);
  for (const ElementId id : {11U, 12U}) {
    EXPECT_TRUE(known(id) && runs_forward(id)) << id;
    EXPECT_EQ(get(id).direction_evidence, Evidence::sd_map) << id;
    EXPECT_EQ(get(id).evidence, Evidence::edges) << "the map does not tell that the lane is there";
  }
  one_way_ = {-1.0, -1.0};
  tracks_ = {};
  find(DrivingSide::unknown);
  EXPECT_TRUE(known(12));
  EXPECT_FALSE(runs_forward(12));
}

TEST_F(Directions, TheOwnDriveOutweighsAOneWayStreet) {
  one_way_ = {-1.0, -1.0};
  for (int i = 0; i < 10; ++i) observe(test::at(10, 1.75));
  find(DrivingSide::unknown);
  EXPECT_TRUE(known(12) && runs_forward(12));
}

TEST_F(Directions, AShortTrailTellsNothing) {
  driven_ = {{.trail = 0, .lane = 0, .along_m = 4.0}, {.trail = 1, .lane = 0, .along_m = 4.0}};
  find(DrivingSide::unknown);
  EXPECT_FALSE(known(11));
  EXPECT_EQ(get(11).evidence, Evidence::none);
}

TEST_F(Directions, ATrailCountsOnceWhereItRunsThroughLanesThatContinueOneAnother) {
  lanes_.push_back(lane(13, 2, 40, 60));
  linkages_ = {{.from = 12, .to = 13}};
  driven_ = {{.trail = 0, .lane = 1, .along_m = 4.0}, {.trail = 0, .lane = 2, .along_m = 4.0}};
  find(DrivingSide::unknown);
  EXPECT_TRUE(known(12) && known(13)) << "8 m in both together";
  const double once = get(12).direction_probability;
  driven_ = {{.trail = 0, .lane = 1, .along_m = 20.0}, {.trail = 0, .lane = 2, .along_m = 20.0}};
  find(DrivingSide::unknown);
  EXPECT_EQ(get(12).direction_probability, once);
}

TEST_F(Directions, FurtherTrailsTellLess) {
  double before = 0.5, rise_before = 1.0;
  for (std::size_t trail = 0; trail < 3; ++trail) {
    driven_.push_back({.trail = trail, .lane = 1, .along_m = 20.0});
    find(DrivingSide::unknown);
    const double rise = get(12).direction_probability - before;
    EXPECT_GT(rise, 0.0) << trail;
    EXPECT_LT(rise, rise_before) << trail;
    before = get(12).direction_probability;
    rise_before = rise;
  }
}

TEST_F(Directions, TwoTrailsOutweighTheEdgeOfTheRoad) {
  divider(MarkingStyle::dashed);  // both lanes run alike
  find();
  EXPECT_FALSE(known(11));
  driven_ = {{.trail = 0, .lane = 0, .along_m = -20.0},
             {.trail = 1, .lane = 0, .along_m = -20.0},
             {.trail = 2, .lane = 1, .along_m = -20.0},
             {.trail = 3, .lane = 1, .along_m = -20.0}};
  find();
  EXPECT_TRUE(known(11) && known(12));
  EXPECT_FALSE(runs_forward(11) || runs_forward(12));
}

}  // namespace
}  // namespace laneloom::topology
