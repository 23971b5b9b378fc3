#include "ros2/road_segments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "road.hpp"

namespace laneloom::ros2 {
namespace {

using ::testing::ElementsAre;

TEST(RoadSegments, AreInTheVehiclesFrame) {
  PublishedMap map = empty_map();
  // Ahead of a vehicle at (100, 50) that looks along y.
  Lane lane;
  lane.id = 1'000'000'000'007;
  lane.left = {Point(98.0, 50.0, 0.0), Point(98.0, 60.0, 0.0)};
  lane.right = {Point(102.0, 50.0, 0.0), Point(102.0, 60.0, 0.0)};
  map.map.lanes = {lane};
  const auto road = to_road_segments(map);
  EXPECT_EQ(road.header().frame_id(), "base_link");
  EXPECT_EQ(road.header().stamp().sec(), 1'700'000'000);
  EXPECT_NEAR(road.pose().position().x(), 100.0, 1e-9);
  EXPECT_NEAR(road.pose().orientation().z(), std::sqrt(0.5), 1e-9);
  ASSERT_EQ(road.segments().size(), 1U);
  const auto& segment = road.segments()[0];
  EXPECT_EQ(segment.id(), 0);
  const auto& left = segment.linestrings()[0].poses();
  const auto& right = segment.linestrings()[1].poses();
  ASSERT_EQ(left.size(), 2U);
  EXPECT_NEAR(left[0].position().y(), 2.0, 1e-9);
  EXPECT_NEAR(right[0].position().y(), -2.0, 1e-9);
  EXPECT_NEAR(left[1].position().x(), 10.0, 1e-9);
  EXPECT_NEAR(left[1].orientation().w(), 1.0, 1e-9);
  EXPECT_THAT(segment.neighboring_segment_id(), ElementsAre(-1, -1));
  EXPECT_THAT(segment.successor_segment_id(), ElementsAre(-1));
}

TEST(RoadSegments, NeighboursAreLeftAndRightAndRunTheSameWay) {
  PublishedMap map = empty_map();
  Lane right = lane_at(11, 0.0, 0.0), left = lane_at(12, 0.0, 4.0), oncoming = lane_at(13, 0.0, 8.0);
  right.left_neighbours = {{12, {0.0, 10.0}}};
  left.right_neighbours = {{11, {0.0, 10.0}}};
  left.left_neighbours = {{13, {0.0, 10.0}}};
  oncoming.left_neighbours = {{12, {0.0, 10.0}}};
  map.map.lanes = {right, left, oncoming};
  const auto road = to_road_segments(map);
  EXPECT_THAT(road.segments()[0].neighboring_segment_id(), ElementsAre(1, -1));
  EXPECT_THAT(road.segments()[1].neighboring_segment_id(), ElementsAre(-1, 0));
  EXPECT_THAT(road.segments()[2].neighboring_segment_id(), ElementsAre(-1, -1));
}

TEST(RoadSegments, LinkagesAreSuccessorsAndAcrossAGapSegmentsOfTheirOwn) {
  PublishedMap map = empty_map();
  map.map.T_map_body = Eigen::Isometry3d::Identity();
  map.map.lanes = {lane_at(1, 0.0, 0.0), lane_at(2, 10.0, 0.0), lane_at(3, 30.0, 0.0)};
  map.map.lanes[2].width_m = 2.0;
  map.map.linkages = {{1, 2}, {2, 3}};
  map.map.linkages[1].path = straight(20.0, 0.0, 10);
  const auto road = to_road_segments(map);
  ASSERT_EQ(road.segments().size(), 4U);
  EXPECT_THAT(road.segments()[0].successor_segment_id(), ElementsAre(1));
  EXPECT_THAT(road.segments()[1].successor_segment_id(), ElementsAre(3));
  const auto& across = road.segments()[3];
  EXPECT_EQ(across.id(), 3);
  EXPECT_THAT(across.successor_segment_id(), ElementsAre(2));
  EXPECT_THAT(across.neighboring_segment_id(), ElementsAre(-1, -1));
  EXPECT_NEAR(across.linestrings()[0].poses().front().position().y(), 2.0, 1e-9);
  EXPECT_NEAR(across.linestrings()[1].poses().front().position().y(), -2.0, 1e-9);
  EXPECT_NEAR(across.linestrings()[0].poses().back().position().y(), 1.0, 1e-9);
  EXPECT_THAT(road.segments()[2].successor_segment_id(), ElementsAre(-1));
}

TEST(RoadSegments, OfAnEmptyMapAreNone) { EXPECT_TRUE(to_road_segments(empty_map()).segments().empty()); }

}  // namespace
}  // namespace laneloom::ros2
