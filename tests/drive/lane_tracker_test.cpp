#include "drive/lane_tracker.hpp"

#include <gtest/gtest.h>

#include "maps.hpp"

namespace laneloom::drive {
namespace {

using Verdict = LaneTracker::Verdict;
const Eigen::Vector2d kEast(1.0, 0.0);

simulation::RoadLane road_lane(ElementId id, const Polyline& centerline,
                               std::vector<ElementId> successors = {}) {
  return {.id = id,
          .left = beside_line(centerline, 1.75),
          .right = beside_line(centerline, -1.75),
          .centerline = centerline,
          .successors = std::move(successors)};
}

/// East: lane 1, then 2; beside it on the left 3 (on to 4, which goes far); oncoming on the right 5.
simulation::Road road() {
  simulation::Road road;
  road.name = "made by hand";
  road.lanes = {road_lane(1, straight_line({0, 0, 0}, {50, 0, 0}), {2}),
                road_lane(2, straight_line({50, 0, 0}, {100, 0, 0})),
                road_lane(3, straight_line({0, 3.5, 0}, {100, 3.5, 0}), {4}),
                road_lane(4, straight_line({100, 3.5, 0}, {300, 3.5, 0})),
                road_lane(5, straight_line({300, -3.5, 0}, {0, -3.5, 0}))};
  return road;
}

TEST(LaneTracker, MeasuresTheOffsetAndFollowsSuccessors) {
  const simulation::Road truth = road();
  LaneTracker lanes(truth);
  lanes.place(0);
  EXPECT_EQ(lanes.move_to({20.0, 0.4}, kEast), Verdict::in_lane);
  EXPECT_NEAR(lanes.offset_m(), 0.4, 1e-9);
  EXPECT_NEAR(lanes.width_m(), 3.5, 1e-9);
  EXPECT_EQ(lanes.move_to({60.0, -0.4}, kEast), Verdict::in_lane);
  EXPECT_EQ(lanes.lanes(), std::vector<std::size_t>{1});
}

TEST(LaneTracker, TellsHowTheLaneWasLeft) {
  const simulation::Road truth = road();
  LaneTracker lanes(truth);
  lanes.place(0);
  EXPECT_EQ(lanes.move_to({20.0, 1.7}, kEast), Verdict::in_lane);
  EXPECT_EQ(lanes.move_to({20.0, 1.8}, kEast), Verdict::changed_lane);
  EXPECT_EQ(lanes.move_to({20.0, -1.8}, kEast), Verdict::oncoming);
  EXPECT_EQ(lanes.move_to({20.0, -6.0}, kEast), Verdict::off_lanes);
}

TEST(LaneTracker, WhereALaneEndsOneMayChangeToAnotherThatGoesOn) {
  const simulation::Road truth = road();
  LaneTracker lanes(truth);
  lanes.place(1);
  EXPECT_EQ(lanes.move_to({60.0, 2.0}, kEast), Verdict::in_lane);
  EXPECT_EQ(lanes.lanes(), std::vector<std::size_t>{2});
}

TEST(LaneTracker, ARoadThatEndsIsNotADeparture) {
  const simulation::Road truth = road();
  LaneTracker lanes(truth);
  lanes.place(3);
  EXPECT_EQ(lanes.move_to({299.9, 3.5}, kEast), Verdict::road_ended);
  lanes.place(1);  // beside it, another goes on: it should have changed
  EXPECT_EQ(lanes.move_to({104.0, 0.0}, kEast), Verdict::off_lanes);
}

TEST(LaneTracker, PutsTheVehicleOnTheSurface) {
  simulation::Road truth = road();
  for (Polyline* line : {&truth.lanes[0].left, &truth.lanes[0].right, &truth.lanes[0].centerline})
    for (Point& point : *line) point.z() = 0.1 * point.x();
  for (Point& point : truth.lanes[0].left) point.z() += 0.35;
  LaneTracker lanes(truth);
  lanes.place(0);
  const Eigen::Isometry3d T_map_body = lanes.on_surface({.rear_axle = {20.0, 1.0}});
  EXPECT_NEAR(T_map_body.translation().z(), 2.1, 1e-6);                           // 0.1 up across
  EXPECT_NEAR(T_map_body.linear()(2, 0) / T_map_body.linear()(0, 0), 0.1, 1e-6);  // along
  EXPECT_NEAR((T_map_body.linear().transpose() * T_map_body.linear() - Eigen::Matrix3d::Identity()).norm(),
              0.0, 1e-9);
  EXPECT_GT(T_map_body.linear()(2, 1), 0.09);
}

}  // namespace
}  // namespace laneloom::drive
