#include "export/weld.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "drives.hpp"
#include "export/single_borders.hpp"
#include "export/strays.hpp"
#include "export/weave.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::exports {
namespace {

using Lanes = std::pair<ElementId, ElementId>;

Polyline points_of(const RoadNetwork& network, const RoadNetwork::Side& side) {
  Polyline points;
  for (const std::size_t node : network.ways[side.way].nodes) points.push_back(network.nodes[node]);
  if (side.reversed) std::ranges::reverse(points);
  return points;
}

/// From which lane one comes into which, by nodes alone; across the lanelets of linkages. Lanelets of no
/// direction also count as they are not drawn.
std::set<Lanes> driveable(const RoadNetwork& network) {
  std::map<DirectedLanelet, std::set<DirectedLanelet>> next;
  for (const auto& [from, to] : followers(network)) next[from].insert(to);
  const auto lane = [&](const DirectedLanelet& directed) { return network.lanelets[directed.lanelet].lane; };
  std::set<Lanes> pairs;
  for (const auto& [from, tos] : next) {
    if (lane(from) == kNoElement) continue;
    for (const DirectedLanelet& to : tos) {
      if (lane(to) != kNoElement) pairs.emplace(lane(from), lane(to));
      if (lane(to) == kNoElement && next.contains(to))
        for (const DirectedLanelet& beyond : next.at(to)) pairs.emplace(lane(from), lane(beyond));
    }
  }
  std::erase_if(pairs, [](const Lanes& pair) { return pair.first == pair.second; });
  return pairs;
}

std::set<Lanes> linked(const LocalMap& map) {
  const auto is_two_way = [&](ElementId id) {
    return std::ranges::find(map.lanes, id, &Lane::id)->direction == Lane::Direction::unknown;
  };
  std::set<Lanes> pairs;
  for (const Linkage& linkage : map.linkages) {
    pairs.emplace(linkage.from, linkage.to);
    if (is_two_way(linkage.from) && is_two_way(linkage.to)) pairs.emplace(linkage.to, linkage.from);
  }
  return pairs;
}

void expect_sound(const RoadNetwork& network) {
  for (const RoadNetwork::Way& way : network.ways) {
    ASSERT_GE(way.nodes.size(), 2u);
    for (std::size_t i = 1; i < way.nodes.size(); ++i) EXPECT_NE(way.nodes[i - 1], way.nodes[i]);
  }
  for (const RoadNetwork::Lanelet& lanelet : network.lanelets) {
    for (const RoadNetwork::Side& side : {lanelet.left, lanelet.right})
      EXPECT_NE(end_node(network, side, false), end_node(network, side, true));
    const Polyline left = points_of(network, lanelet.left);
    const MeasuredPolyline right(points_of(network, lanelet.right));
    EXPECT_GT(right.project(left[left.size() / 2]).lateral_m, 0.0)
        << "lanelet of lane " << lanelet.lane << " of " << left.size() << " nodes at " << left[0].transpose();
  }
}

/// The neighbours that lie beside a lane for so long that both have a lanelet there.
std::set<Lanes> neighbours(const LocalMap& map) {
  constexpr double kLong_m = 6.0;
  std::set<Lanes> pairs;
  for (const Lane& lane : map.lanes)
    for (const auto* side : {&lane.left_neighbours, &lane.right_neighbours})
      for (const Neighbour& neighbour : *side)
        if (neighbour.range.length() > kLong_m) pairs.insert(std::minmax(lane.id, neighbour.lane));
  return pairs;
}

std::set<Lanes> sharing_ways(const RoadNetwork& network) {
  std::map<std::size_t, std::set<ElementId>> lanes_of_way;
  for (const RoadNetwork::Lanelet& lanelet : network.lanelets)
    if (lanelet.lane != kNoElement)
      for (const RoadNetwork::Side& side : {lanelet.left, lanelet.right})
        lanes_of_way[side.way].insert(lanelet.lane);
  std::set<Lanes> pairs;
  for (const auto& [way, lanes] : lanes_of_way)
    for (const ElementId a : lanes)
      for (const ElementId b : lanes)
        if (a < b) pairs.emplace(a, b);
  return pairs;
}

class Welded : public testing::TestWithParam<std::string> {};

TEST_P(Welded, TheTopologyIsInTheNodesAndWays) {
  const test::MappedDrive drive = test::map_drive(GetParam(), "inhouse");
  const LocalMap map = weave(test::surveyed(drive), drive.config);
  ASSERT_FALSE(map.lanes.empty());
  const RoadNetwork network = weld(map);
  expect_sound(network);
  EXPECT_EQ(driveable(network), linked(map));
  const std::set<Lanes> shared = sharing_ways(network);
  for (const Lanes& pair : neighbours(map))
    EXPECT_TRUE(shared.contains(pair)) << pair.first << " and " << pair.second << " share no way";
  for (const Lane& lane : map.lanes)
    EXPECT_TRUE(std::ranges::count(network.lanelets, lane.id, &RoadNetwork::Lanelet::lane) > 0);
}

INSTANTIATE_TEST_SUITE_P(Roads, Welded, testing::ValuesIn(simulation::scenario_names()),
                         [](const auto& road) { return road.param; });

/// Two lanes, one behind the other, and a third beside both of them.
LocalMap three_lanes() {
  LocalMap map;
  for (const ElementId id : {1U, 2U, 3U}) {
    const double y = 3.5 * (2.0 - static_cast<double>(id));
    map.boundaries.push_back(
        {.id = id, .points = {{0, y, 0}, {40, y, 0}}, .styles = {{{0, 40}, MarkingStyle::dashed}}});
  }
  const auto add = [&](ElementId id, ElementId left, const Stretch& range) {
    const double y = 3.5 * (2.0 - static_cast<double>(left));
    const auto line = [&](double at) { return Polyline{{range.from_m, at, 0}, {range.to_m, at, 0}}; };
    map.lanes.push_back({.id = id,
                         .left_borders = {{left, {0.0, range.length()}, range}},
                         .right_borders = {{left + 1, {0.0, range.length()}, range}},
                         .left = line(y),
                         .right = line(y - 3.5),
                         .centerline = line(y - 1.75),
                         .width_m = 3.5,
                         .direction = Lane::Direction::along_centerline});
  };
  add(11, 1, {0, 20});
  add(12, 1, {20.5, 40});
  add(13, 2, {0, 40});
  return map;
}

TEST(Weld, LanesThatMeetAreNotDrivenFromOneIntoTheOtherUnlessTheyAreLinked) {
  LocalMap map = three_lanes();
  EXPECT_THAT(driveable(weld(map)), testing::IsEmpty());
  map.linkages = {{.from = 11, .to = 12}};
  EXPECT_THAT(driveable(weld(map)), testing::ElementsAre(Lanes(11, 12)));
}

TEST(Weld, WhatEndsBesideALaneCutsItSoThatTheyShareWays) {
  const RoadNetwork network = weld(three_lanes());
  expect_sound(network);
  EXPECT_EQ(network.lanelets.size(), 4u);
  EXPECT_THAT(sharing_ways(network), testing::ElementsAre(Lanes(11, 13), Lanes(12, 13)));
}

TEST(Weld, ALaneWithSeveralBordersIsCutWhereTheyChange) {
  LocalMap map = three_lanes();
  Lane& lane = map.lanes[2];  // below boundary 2, to which boundary 4 is the successor
  map.boundaries[1].points.back().x() = 15.0;
  map.boundaries[1].styles = {{{0, 15}, MarkingStyle::dashed}};
  map.boundaries.push_back(
      {.id = 4, .points = {{40, 0, 0}, {15, 0, 0}}, .styles = {{{0, 25}, MarkingStyle::solid}}});
  lane.left_borders = {{2, {0, 15}, {0, 15}}, {4, {15, 40}, {0, 25}, true}};
  lane.right_borders = {{3, {0, 30}, {0, 30}}, {kNoElement, {30, 40}, {}}};
  map.lanes = {lane};
  const LocalMap single = with_single_borders(map);
  ASSERT_EQ(single.lanes.size(), 3u);
  const auto ends = [&](std::size_t i) {
    return std::pair(single.lanes[i].centerline.front().x(), single.lanes[i].centerline.back().x());
  };
  EXPECT_EQ(ends(0), std::pair(0.0, 15.0));
  EXPECT_EQ(ends(1), std::pair(15.0, 30.0));
  EXPECT_EQ(ends(2), std::pair(30.0, 40.0));
  EXPECT_EQ(single.lanes[0].id, lane.id);
  EXPECT_EQ(single.lanes[1].left_borders.at(0).on_boundary.from_m, 10.0) << "boundary 4 runs against it";
  EXPECT_EQ(single.lanes[1].left_borders.at(0).on_boundary.to_m, 25.0);
  EXPECT_EQ(single.boundaries.back().status, ElementStatus::inferred) << "the unseen border";
  EXPECT_EQ(single.lanes[2].right_borders.at(0).boundary, single.boundaries.back().id);
  ASSERT_EQ(single.linkages.size(), 2u);
  const RoadNetwork network = weld(map);
  expect_sound(network);
  EXPECT_EQ(network.lanelets.size(), 3u);
  EXPECT_EQ(driveable(network).size(), 2u);
}

TEST(Weld, WhatLedOutOfACutLaneLeadsOutOfItsLastPart) {
  LocalMap map = three_lanes();
  map.lanes[0].left_borders = {{1, {0, 10}, {0, 10}}, {1, {10, 20}, {10, 20}}};
  map.linkages = {{.from = 11, .to = 12}};
  map.stoplines = {{.marking = {.id = 5}, .lanes = {11}}};
  const LocalMap single = with_single_borders(map);
  ASSERT_EQ(single.lanes.size(), 4u);
  const ElementId last = single.lanes[1].id;
  EXPECT_EQ(single.linkages[0].from, last);
  EXPECT_EQ(single.linkages[0].to, 12u);
  EXPECT_EQ(single.stoplines[0].lanes, std::vector{last});
}

TEST(Weld, AnEmptyMapIsAnEmptyNetwork) {
  const RoadNetwork network = weld(LocalMap{});
  EXPECT_TRUE(network.lanelets.empty());
  EXPECT_TRUE(network.nodes.empty());
}

}  // namespace
}  // namespace laneloom::exports
