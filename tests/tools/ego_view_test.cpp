#include "pnc/ego_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace laneloom {
namespace {

using testing::ElementsAre;

/// A lane along x whose width goes from `width_from` to `width_to`.
Lane lane(ElementId id, double from_x, double to_x, double right_y, double width_from, double width_to) {
  Lane l;
  l.id = id;
  l.right = {{from_x, right_y, 0}, {to_x, right_y, 0}};
  l.left = {{from_x, right_y + width_from, 0}, {to_x, right_y + width_to, 0}};
  l.centerline = {{from_x, right_y + width_from / 2, 0}, {to_x, right_y + width_to / 2, 0}};
  l.width_m = (width_from + width_to) / 2;
  return l;
}

void link(LocalMap& map, ElementId from, ElementId to) {
  Linkage linkage;
  linkage.from = from;
  linkage.to = to;
  map.linkages.push_back(linkage);
}

/// Lane 1 (3 m wide, x 0..15, y 0..3) with lane 2 on its left; lane 3 (4 m wide, x 15..30) follows lane 1.
LocalMap road() {
  LocalMap map;
  map.lanes = {lane(1, 0, 15, 0, 3, 3), lane(2, 0, 15, 3, 3, 3), lane(3, 15, 30, 0, 4, 4)};
  map.lanes[0].left_neighbours = {{.lane = 2, .range = {0.0, 20.0}}};
  map.lanes[1].right_neighbours = {{.lane = 1, .range = {0.0, 20.0}}};
  link(map, 1, 3);
  map.T_map_body.translation() = Point(1, 1, 0);
  return map;
}

TEST(EgoView, FindsTheLaneAndWhatIsAroundIt) {
  const pnc::EgoView view = pnc::ego_view(road());
  EXPECT_EQ(view.lane, 1u);
  EXPECT_EQ(view.left_neighbour, 2u);
  EXPECT_EQ(view.right_neighbour, kNoElement);
  EXPECT_THAT(view.successors, ElementsAre(3u));
  EXPECT_NEAR(view.offset_m, -0.5, 1e-9);
}

TEST(EgoView, TellsTheWidthAlongTheWay) {
  LocalMap map = road();
  map.way = Way{.step_m = 2.0, .stations = std::vector<WayStation>(15)};  // 28 m
  map.way->stations[5].width_m = 3.0;
  const pnc::EgoView view = pnc::ego_view(map);
  EXPECT_EQ(view.width_m[0], 3.0);
  EXPECT_FALSE(view.width_m[1].has_value()) << "is not known";
  EXPECT_FALSE(view.width_m[2].has_value()) << "the way has ended";
  EXPECT_FALSE(pnc::ego_view(road()).width_m[0].has_value()) << "there is no way";
}

TEST(EgoView, SeesALaneThatIsGivenAgainstTheVehicle) {
  LocalMap map = road();
  map.lanes[2].id = 7;
  Lane& ego = map.lanes[0];
  for (Polyline* line : {&ego.left, &ego.right, &ego.centerline}) std::reverse(line->begin(), line->end());
  std::swap(ego.left, ego.right);
  std::swap(ego.left_neighbours, ego.right_neighbours);
  map.linkages.clear();
  link(map, 7, 1);  // ahead of the vehicle, where the lane's points begin
  const pnc::EgoView view = pnc::ego_view(map);
  EXPECT_EQ(view.lane, 1u);
  EXPECT_EQ(view.left_neighbour, 2u);
  EXPECT_THAT(view.successors, ElementsAre(7u));
  EXPECT_NEAR(view.offset_m, -0.5, 1e-9);
}

TEST(EgoView, IsInNoLaneOffTheRoadBeforeItOrAcrossIt) {
  LocalMap map = road();
  map.T_map_body.translation() = Point(1, -1, 0);
  EXPECT_EQ(pnc::ego_view(map).lane, kNoElement);
  map.T_map_body.translation() = Point(-1, 1, 0);
  EXPECT_EQ(pnc::ego_view(map).lane, kNoElement);
  map.T_map_body.translation() = Point(1, 1, 0);
  map.T_map_body.rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Point::UnitZ()));
  EXPECT_EQ(pnc::ego_view(map).lane, kNoElement);
  EXPECT_EQ(pnc::ego_view(LocalMap{}).lane, kNoElement);
}

TEST(EgoView, PrefersTheLaneThatItIsAlignedWith) {
  LocalMap map = road();
  Lane turning = lane(9, -5, 15, 0, 3, 3);
  for (Polyline* line : {&turning.left, &turning.right, &turning.centerline})
    for (Point& point : *line)
      point =
          Eigen::AngleAxisd(std::numbers::pi / 6, Point::UnitZ()) * (point - Point(1, 1, 0)) + Point(1, 1, 0);
  map.lanes.insert(map.lanes.begin(), turning);
  EXPECT_EQ(pnc::ego_view(map).lane, 1u);
}

}  // namespace
}  // namespace laneloom
