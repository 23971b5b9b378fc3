#include "ros2/markers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "road.hpp"
#include "ros2/shapes.hpp"

namespace laneloom::ros2 {
namespace {

using Array = visualization_msgs::msg::dds_::MarkerArray_;
using Keys = std::set<std::pair<std::string, std::int32_t>>;

Keys keys(const Array& array, MarkerAction action) {
  Keys found;
  for (const auto& marker : array.markers()) {
    if (marker.action() != action) continue;
    EXPECT_TRUE(found.emplace(marker.ns(), marker.id()).second) << marker.ns();
  }
  return found;
}

const visualization_msgs::msg::dds_::Marker_& first(const Array& array, std::string_view ns) {
  return *std::ranges::find_if(array.markers(), [&](const auto& marker) { return marker.ns() == ns; });
}

PublishedMap road() {
  PublishedMap map = empty_map();
  map.map.lanes = {lane_at(7, 0.0, 0.0), lane_at(8, 20.0, 0.0)};
  Marking boundary;
  boundary.id = 7;  // that of a lane, too
  boundary.points = straight(0.0, 2.0, 10);
  boundary.styles = {{{0.0, 5.0}, MarkingStyle::solid}, {{5.0, 10.0}, MarkingStyle::dashed}};
  map.map.boundaries = {boundary};
  Stopline stopline;
  stopline.marking.id = 9;
  stopline.marking.points = {Point(10.0, -2.0, 0.0), Point(10.0, 2.0, 0.0)};
  map.map.stoplines = {stopline};
  map.map.linkages = {{7, 8}, {7, 8}};
  map.map.linkages.back() = {.from = 8, .to = 7, .path = straight(10.0, 0.0, 10)};
  map.map.way = Way{.stations = {{.point = {1.0, 0.5, 0.0}}, {.point = {2.0, 0.5, 0.0}}}, .lanes = {}};
  return map;
}

TEST(Markers, AreTheSameForAsLongAsTheElementIsThere) {
  Markers markers;
  const auto map = road();
  const Array before = markers.update(map), after = markers.update(map);
  // Two lanes, a boundary, a stopline, the linkage that has a path, the way, the state.
  EXPECT_EQ(keys(before, kAdd).size(), 7U);
  EXPECT_EQ(keys(after, kAdd), keys(before, kAdd));
  EXPECT_TRUE(keys(after, kDelete).empty());
  for (const auto& marker : after.markers()) {
    EXPECT_EQ(marker.header().frame_id(), "map");
    EXPECT_EQ(marker.header().stamp().nanosec(), 250'000'000U);
    EXPECT_EQ(marker.lifetime().sec(), 1);
    EXPECT_EQ(marker.pose().orientation().w(), 1.0);
  }
}

TEST(Markers, OfWhatLeavesTheMapAreDeletedOnce) {
  Markers markers;
  auto map = road();
  const Array before = markers.update(map);
  map.map.lanes.erase(map.map.lanes.begin());
  map.map.boundaries.clear();
  map.map.way.reset();
  const Array after = markers.update(map);
  Keys expected;
  std::ranges::set_difference(keys(before, kAdd), keys(after, kAdd),
                              std::inserter(expected, expected.begin()));
  EXPECT_EQ(expected.size(), 3U);
  EXPECT_EQ(keys(after, kDelete), expected);
  EXPECT_TRUE(keys(markers.update(map), kDelete).empty());
  // One that comes back does not take the id of another one.
  const Keys again = keys(markers.update(road()), kAdd);
  EXPECT_EQ(again.size(), 7U);
}

TEST(Markers, LinesHaveAColourForEachPoint) {
  const Array array = Markers().update(road());
  const auto& line = first(array, "boundaries");
  EXPECT_EQ(line.type(), kLineStrip);
  EXPECT_GT(line.scale().x(), 0.0);
  ASSERT_EQ(line.points().size(), 11U);
  ASSERT_EQ(line.colors().size(), 11U);
  EXPECT_EQ(line.colors()[0].r(), 1.0F);
  EXPECT_NE(line.colors()[9].r(), line.colors()[0].r());
}

TEST(Markers, LanesAreFilledWithTriangles) {
  PublishedMap map = empty_map();
  map.map.lanes = {lane_at(1, 0.0, 0.0)};
  map.map.lanes[0].left = {Point(0.0, 2.0, 0.0), Point(10.0, 2.0, 0.0)};  // fewer points than the right side
  const Array array = Markers().update(map);
  const auto& points = first(array, "lanes").points();
  ASSERT_EQ(points.size() % 3, 0U);
  double area_m2 = 0.0;
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const auto corner = [&](std::size_t j) { return Eigen::Vector2d(points[i + j].x(), points[i + j].y()); };
    const Eigen::Vector2d a = corner(1) - corner(0), b = corner(2) - corner(0);
    area_m2 += std::abs(a.x() * b.y() - a.y() * b.x()) / 2.0;
  }
  EXPECT_NEAR(area_m2, 40.0, 1e-9);
}

TEST(Markers, TheStateStandsAboveTheVehicle) {
  PublishedMap map = empty_map();
  map.state = MapState::stale;
  map.reasons = {StateReason::no_poses};
  const Array array = Markers().update(map);
  const auto& text = first(array, "state");
  EXPECT_EQ(text.text(), "STALE no_poses");
  EXPECT_EQ(text.type(), kTextViewFacing);
  EXPECT_NEAR(text.pose().position().x(), 100.0, 1e-9);
  EXPECT_NEAR(text.pose().position().z(), 3.0, 1e-9);
}

}  // namespace
}  // namespace laneloom::ros2
