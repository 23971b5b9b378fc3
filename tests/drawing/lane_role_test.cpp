#include "drawing/lane_role.hpp"

#include <gtest/gtest.h>

#include "drawing/map_elements.hpp"
#include "small_map.hpp"

namespace laneloom::drawing {
namespace {

const Eigen::Isometry3d kAtOrigin = Eigen::Isometry3d::Identity();

Lane lane_to(const Point& end, Lane::Direction direction) {
  Lane lane;
  lane.id = 5;
  lane.centerline = {{0, 4, 0}, Point(Point(0, 4, 0) + end)};
  lane.direction = direction;
  return lane;
}

TEST(LaneRole, IsTheSenseOfTrafficAsTheVehicleDrives) {
  using enum Lane::Direction;
  const auto role = [](const Point& end, Lane::Direction direction) {
    return role_of(lane_to(end, direction), kNoElement, kAtOrigin);
  };
  EXPECT_EQ(role({10, 0, 0}, along_centerline), LaneRole::same_way);
  EXPECT_EQ(role({10, 0, 0}, against_centerline), LaneRole::oncoming);
  EXPECT_EQ(role({-10, 0, 0}, along_centerline), LaneRole::oncoming);
  EXPECT_EQ(role({-10, 0, 0}, against_centerline), LaneRole::same_way);
  EXPECT_EQ(role({10, 0, 0}, both), LaneRole::oncoming);
  EXPECT_EQ(role({0, 10, 0}, along_centerline), LaneRole::crossing);
  EXPECT_EQ(role({10, 0, 0}, unknown), LaneRole::unknown);
}

TEST(LaneRole, OfTheOwnLaneAndOfAShoulderNeedsNoDirection) {
  Lane lane = lane_to({10, 0, 0}, Lane::Direction::unknown);
  EXPECT_EQ(role_of(lane, 5, kAtOrigin), LaneRole::own);
  lane.use = Lane::Use::shoulder;
  EXPECT_EQ(role_of(lane, kNoElement, kAtOrigin), LaneRole::unused);
}

TEST(LaneRole, TheOwnLaneIsTheOneUnderTheVehicle) {
  LocalMap map = small_map();
  map.T_map_body.translate(Point(3, 0.5, 0));
  EXPECT_EQ(own_lane_of(map), 21U);
  map.T_map_body.translate(Point(0, 5, 0));
  EXPECT_EQ(own_lane_of(map), kNoElement);
}

std::size_t hatched(const LocalMap& map) {
  Drawing drawing;
  add_lanes(map, drawing);
  std::size_t count = 0;
  for (const Element& element : drawing.elements())
    for (const Shape& shape : element.shapes) count += shape.style == Style::inferred ? 1 : 0;
  return count;
}

TEST(LaneRole, InferredStretchesAreHatched) {
  LocalMap map = small_map();
  EXPECT_EQ(hatched(map), 0U);
  map.lanes[0].inferred_ranges = {{0, 4}, {6, 10}};
  EXPECT_EQ(hatched(map), 2U);
  map.lanes[0].status = ElementStatus::inferred;
  EXPECT_EQ(hatched(map), 1U) << "all of an inferred lane is";
}

}  // namespace
}  // namespace laneloom::drawing
