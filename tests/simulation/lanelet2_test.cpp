#include "simulation/lanelet2.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "laneloom/polyline.hpp"
#include "road_checks.hpp"
#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::simulation {
namespace {

namespace fs = std::filesystem;

Road load_real(const std::string& name) { return load_lanelet2(fs::path(LANELOOM_DATA) / "lanelet2" / name); }

bool absent(const std::string& name) { return !fs::exists(fs::path(LANELOOM_DATA) / "lanelet2" / name); }

std::ptrdiff_t count(const Road& road, MarkingType type) {
  return std::count_if(road.markings.begin(), road.markings.end(),
                       [&](const RoadMarking& m) { return m.type == type; });
}

void expect_smooth_drive(const Road& road) {
  for (double t = 0.1; t < road.drive.duration_s(); t += 0.1) {
    const VehiclePose before = road.drive.pose_at(t - 0.1), now = road.drive.pose_at(t);
    EXPECT_LT((now.position - before.position).norm(), 1.1) << "at " << t;
    EXPECT_LT(now.orientation.angularDistance(before.orientation), 0.35) << "at " << t;
  }
}

TEST(RealMap, Karlsruhe) {
  if (absent("karlsruhe_mapping_example.osm")) GTEST_SKIP() << "no Lanelet2 maps in " << LANELOOM_DATA;
  const Road road = load_real("karlsruhe_mapping_example.osm");
  EXPECT_EQ(road.lanes.size(), 328u);  // lanelets of subtype road and highway, but for those of bicycles
  EXPECT_EQ(count(road, MarkingType::stopline), 28);
  EXPECT_GT(count(road, MarkingType::laneline), 100);
  EXPECT_TRUE(road.right_hand_traffic);
  for (const RoadLane& lane : road.lanes) {
    expect_left_is_left(lane);
    expect_successors_meet(road, lane, 1e-6);
  }
  expect_borders_on_markings(road, 1e-6);
  EXPECT_GT(road.drive.duration_s(), 20.0);
  expect_smooth_drive(road);
}

TEST(RealMap, Kashiwanoha) {
  if (absent("kashiwanoha.osm")) GTEST_SKIP() << "no Lanelet2 maps in " << LANELOOM_DATA;
  const Road road = load_real("kashiwanoha.osm");
  EXPECT_EQ(road.lanes.size(), 77u);
  EXPECT_EQ(count(road, MarkingType::stopline), 2);
  EXPECT_FALSE(road.right_hand_traffic);
  EXPECT_EQ(std::count_if(road.lanes.begin(), road.lanes.end(),
                          [](const RoadLane& l) { return l.in_intersection; }),
            38);
  for (const RoadLane& lane : road.lanes) {
    expect_left_is_left(lane);
    expect_successors_meet(road, lane, 1e-6);
  }
  EXPECT_GT(road.drive.duration_s(), 100.0);
  expect_smooth_drive(road);
}

class MadeUpMap : public testing::Test {
 protected:
  Road load(const std::string& content) {
    std::ofstream(path) << content;
    return load_lanelet2(path, 10.0);
  }
  /// Leaves out what is wrong.
  Road load_rest(const std::string& content) {
    std::ofstream(path) << content;
    left_out = LeftOut();
    return load_lanelet2(path, 10.0, left_out);
  }
  std::string error(const std::string& content) {
    return thrown_by<std::exception>([&] { load(content); });
  }

  static std::string tag(const std::string& k, const std::string& v) {
    return "<tag k='" + k + "' v='" + v + "'/>";
  }
  static std::string node(int id, double x, double y) {
    return "<node id='" + std::to_string(id) + "' lat='0' lon='0'>" + tag("local_x", std::to_string(x)) +
           tag("local_y", std::to_string(y)) + tag("ele", "7") + "</node>";
  }
  static std::string way(int id, std::initializer_list<int> nodes, const std::string& tags) {
    std::string out = "<way id='" + std::to_string(id) + "'>";
    for (const int n : nodes) out += "<nd ref='" + std::to_string(n) + "'/>";
    return out + tags + "</way>";
  }
  static std::string lanelet(int id, int left, int right, const std::string& subtype = "road") {
    return "<relation id='" + std::to_string(id) + "'><member type='way' role='left' ref='" +
           std::to_string(left) + "'/><member type='way' role='right' ref='" + std::to_string(right) + "'/>" +
           tag("type", "lanelet") + tag("subtype", subtype) + "</relation>";
  }
  // Two lanes in a row, eastward; the right border of the first is drawn westward.
  static std::string two_lanes() {
    return "<osm>" + node(1, 0, 0) + node(2, 20, 0) + node(3, 40, 0) + node(4, 0, -3) + node(5, 20, -3) +
           node(6, 40, -3) + way(11, {1, 2}, tag("type", "line_thin") + tag("subtype", "dashed")) +
           way(12, {2, 3}, tag("type", "line_thick") + tag("subtype", "dashed")) +
           way(13, {5, 4}, tag("type", "curbstone") + tag("subtype", "low")) +
           way(14, {5, 6}, tag("type", "virtual")) + way(15, {3, 6}, tag("type", "stop_line")) +
           lanelet(21, 11, 13) + lanelet(22, 12, 14) + lanelet(23, 12, 14, "walkway");
  }
  const TemporaryFolder folder;
  const fs::path path = folder.file("made_up.osm");
  LeftOut left_out;
};

TEST_F(MadeUpMap, BordersAreOrientedAndLanesConnected) {
  const Road road = load(two_lanes() + "</osm>");
  ASSERT_EQ(road.lanes.size(), 2u);
  EXPECT_EQ(road.lanes[0].right, (Polyline{{0.0, -3.0, 7.0}, {20.0, -3.0, 7.0}}));
  EXPECT_EQ(road.lanes[0].successors, std::vector<ElementId>{road.lanes[1].id});
  EXPECT_EQ(road.lanes[1].right_marking, kNoElement) << "virtual";
  EXPECT_EQ(road.lanes[0].left_marking, road.lanes[1].left_marking) << "one dashed line along both";
  EXPECT_EQ(count(road, MarkingType::laneline), 1);
  EXPECT_EQ(count(road, MarkingType::roadedge), 1);
  EXPECT_EQ(count(road, MarkingType::stopline), 1);
  EXPECT_NEAR(road.drive.duration_s(), 4.0, 0.01);
}

TEST_F(MadeUpMap, LaneletsForVehiclesAreLanes) {
  const auto lanes_with = [&](const std::string& tags) {
    std::string map = two_lanes() + lanelet(24, 13, 11);
    const std::string subtype = tag("subtype", "road");
    map.replace(map.rfind(subtype), subtype.size(), tags);
    return load(map + "</osm>").lanes.size() - 2;
  };
  const std::string walkway = tag("subtype", "walkway"), road = tag("subtype", "road");
  EXPECT_EQ(lanes_with(""), 1u) << "a lanelet without a subtype is one of vehicles";
  EXPECT_EQ(lanes_with(walkway), 0u);
  EXPECT_EQ(lanes_with(walkway + tag("participant:vehicle", "yes")), 1u);
  EXPECT_EQ(lanes_with(walkway + tag("participant:pedestrian", "yes")), 0u);
  EXPECT_EQ(lanes_with(road + tag("participant:vehicle:bus", "yes") + tag("participant:bicycle", "yes")), 1u);
  EXPECT_EQ(lanes_with(road + tag("participant:vehicle", "no")), 0u);
  EXPECT_EQ(lanes_with(road + tag("participant:bicycle", "yes")), 0u) << "others are disallowed";
}

TEST_F(MadeUpMap, OppositeLanesThatShareABorderTellTheSideOfTraffic) {
  // Many lanes in a row, and one beside the first in the opposite direction.
  std::string row, opposite = node(201, 0, 3) + node(202, 20, 3) + way(400, {202, 201}, "");
  for (int i = 0; i < 30; ++i) {
    row += node(1 + i, 20.0 * i, 0) + node(101 + i, 20.0 * i, -3);
    if (i > 0)
      row += way(300 + i, {i, i + 1}, tag("type", "line_thin")) + way(350 + i, {100 + i, 101 + i}, "");
    if (i > 0) row += lanelet(500 + i, 300 + i, 350 + i);
  }
  const auto side = [&](const std::string& more) { return load("<osm>" + row + more + "</osm>"); };
  EXPECT_TRUE(side("").right_hand_traffic);
  EXPECT_TRUE(side(opposite + way(401, {2, 1}, "") + lanelet(600, 401, 400)).right_hand_traffic);
  const std::string below = node(203, 0, -6) + node(204, 20, -6) + way(402, {204, 203}, "");
  EXPECT_FALSE(side(below + way(403, {102, 101}, "") + lanelet(600, 402, 403)).right_hand_traffic);
}

TEST_F(MadeUpMap, OppositeLanesThatShareNoBorderTellTheSideOfTraffic) {
  const auto with_opposite_at = [&](double y) {
    return load(two_lanes() + node(201, 0, y) + node(202, 20, y) + node(203, 0, y + 3) +
                node(204, 20, y + 3) + way(301, {202, 201}, "") + way(302, {204, 203}, "") +
                lanelet(401, 301, 302) + "</osm>");
  };
  EXPECT_TRUE(with_opposite_at(0.5).right_hand_traffic);
  EXPECT_FALSE(with_opposite_at(-6.5).right_hand_traffic);
  EXPECT_TRUE(with_opposite_at(-20.0).right_hand_traffic) << "it is no neighbour";
  EXPECT_TRUE(with_opposite_at(-3.1).right_hand_traffic) << "one lane for both directions has no side";
}

TEST_F(MadeUpMap, SwappedBordersTurnTheLaneAround) {
  const Road road = load(two_lanes() + lanelet(24, 13, 11) + "</osm>");
  ASSERT_EQ(road.lanes.size(), 3u);
  expect_left_is_left(road.lanes[2]);
  EXPECT_EQ(road.lanes[2].left.front(), Point(20.0, -3.0, 7.0)) << "westward";
}

TEST_F(MadeUpMap, DegreesBecomeMetres) {
  const auto at = [](int id, double lat, double lon) {
    return "<node id='" + std::to_string(id) + "' lat='" + std::to_string(lat) + "' lon='" +
           std::to_string(lon) + "'/>";
  };
  const Road road =
      load("<osm>" + at(1, 49.0, 8.0) + at(2, 49.0, 8.001) + at(3, 48.9999, 8.0) + at(4, 48.9999, 8.001) +
           way(11, {1, 2}, tag("type", "line_thin")) + way(12, {3, 4}, "") + lanelet(21, 11, 12) + "</osm>");
  // On the WGS84 ellipsoid at 49 degrees, 0.001 degrees are 73.17 m of longitude and 111.21 m of latitude.
  EXPECT_NEAR(length(road.lanes[0].left), 73.17, 0.02);
  EXPECT_NEAR(road.lanes[0].right.front().y(), -11.12, 0.01);
}

TEST_F(MadeUpMap, BadMapsAreNamedWithTheirElement) {
  EXPECT_NE(error("<osm><node").find("made_up.osm"), std::string::npos);
  EXPECT_NE(error("<html/>").find("is a web page; a Lanelet2 map (.osm) is needed"), std::string::npos);
  EXPECT_NE(error("<gpx/>").find("has no element osm"), std::string::npos);
  EXPECT_NE(error("<osm/>").find("has no relation of the type lanelet, as an extract of OpenStreetMap"),
            std::string::npos);
  EXPECT_NE(error(two_lanes() + lanelet(30, 11, 99) + "</osm>").find("relation 30: has no way 99"),
            std::string::npos);
  EXPECT_NE(error(two_lanes() + way(40, {1, 77}, "") + "</osm>").find("way 40: has no node 77"),
            std::string::npos);
  EXPECT_NE(
      error("<osm><node id='8' lat='nan' lon='3'/></osm>").find("node 8: has no number within reach as lat"),
      std::string::npos);
  EXPECT_NE(error("<osm><node id='8' lat='95' lon='3'/></osm>").find("node 8"), std::string::npos);
  EXPECT_THROW(load_lanelet2(path.parent_path() / "absent.osm"), std::runtime_error);
  const std::string far = two_lanes() + node(7, 2e5, 0) + node(8, 2e5, -3) + way(41, {1, 7}, "") +
                          way(42, {4, 8}, "") + lanelet(31, 41, 42) + "</osm>";
  EXPECT_NE(error(far).find("relation 31: is beyond 300 km of lines"), std::string::npos) << error(far);
}

TEST_F(MadeUpMap, AMapOfWhichNothingCanBeSeenIsRefused) {
  std::string map = two_lanes();
  for (const std::string type : {"line_thin", "line_thick", "curbstone"})
    map.replace(map.find("'" + type + "'"), type.size() + 2, "'virtual'");
  EXPECT_NE(error(map + "</osm>").find("made_up.osm: has no lines that can be seen"), std::string::npos)
      << "it has a stop line";
  EXPECT_EQ(load(map + way(50, {1, 3}, tag("type", "road_border")) + "</osm>").lanes.size(), 2u);
}

TEST_F(MadeUpMap, WhatIsWrongIsLeftOutWithWhatHangsOnIt) {
  const std::string bad =
      "<node id='8' lat='nan' lon='3'><tag k='local_x' v='x'/><tag k='local_y' v='1'/></node>" +
      way(40, {1, 77}, tag("type", "line_thin")) + way(41, {1, 8}, "") + lanelet(30, 40, 13) +
      lanelet(31, 11, 99) + lanelet(22, 12, 14) + "</osm>";
  const Road road = load_rest(two_lanes() + bad);
  EXPECT_EQ(road.lanes.size(), 2u);
  EXPECT_EQ(road.markings.size(), load(two_lanes() + "</osm>").markings.size());
  EXPECT_EQ(left_out.summary(),
            "1 x a node that has no number within reach as local_x (first: node 8), "
            "2 x a way that has no node (first: way 40), "
            "2 x a relation that has no way (first: relation 30), "
            "1 x a relation that is given twice (first: relation 22)");
}

TEST_F(MadeUpMap, AHeightThatIsNoNumberCountsAsAbsent) {
  std::string map = two_lanes();
  const std::string height = tag("ele", "7");
  map.replace(map.find(height), height.size(), tag("ele", "nan"));
  const Road road = load_rest(map + "</osm>");
  ASSERT_EQ(road.lanes.size(), 2u);
  EXPECT_EQ(road.lanes[0].left, (Polyline{{0.0, 0.0, 0.0}, {20.0, 0.0, 7.0}}));
  EXPECT_EQ(left_out.summary(), "1 x the height of a node, whose ele is no number (first: node 1)");
  EXPECT_NE(error(map + "</osm>").find("node 1: has no number within reach as ele"), std::string::npos);
}

TEST_F(MadeUpMap, TheReasonWhyThereAreNoLanesIsTold) {
  const auto reason = [&](const std::string& content) { return thrown_by([&] { load_rest(content); }); };
  EXPECT_NE(reason("<osm>" + node(1, 0, 0) + "<node")
                .find("has no lanes for vehicles before the place where it is damaged or cut off"),
            std::string::npos);
  const std::string walkway = lanelet(21, 11, 12, "walkway");
  EXPECT_NE(reason("<osm>" + walkway + lanelet(22, 11, 12, "crosswalk") + "</osm>")
                .find("has no lanes for vehicles; its lanelets are crosswalk and walkway"),
            std::string::npos);
  EXPECT_TRUE(
      reason("<osm>" + walkway + lanelet(22, 11, 12) + "</osm>").ends_with("has no lanes for vehicles"))
      << "what is wrong with that of vehicles is told as left out";
}

TEST_F(MadeUpMap, ANodeWithoutLocalCoordinatesDoesNotMoveTheMap) {
  for (const std::string place : {"lat='49' lon='8'", "lat='' lon=''"}) {
    const Road road = load_rest(two_lanes() + "<node id='8' " + place + "/>" +
                                way(41, {1, 8}, tag("type", "line_thin")) + "</osm>");
    ASSERT_EQ(road.lanes.size(), 2u);
    EXPECT_EQ(road.lanes[0].left.front(), Point(0.0, 0.0, 7.0)) << "in local coordinates";
    EXPECT_EQ(left_out.summary(),
              "1 x a node that has no local_x and local_y, as most nodes have (first: node 8), "
              "1 x a way that has no node (first: way 41)");
  }
}

TEST_F(MadeUpMap, DeletedElementsArePassedOver) {
  const std::string deleted =
      "<node id='9' action='delete' visible='true' lat='0' lon='0'/>"
      "<way id='50' action='delete'><nd ref='9'/></way>"
      "<relation id='60' visible='false'><member type='way' role='left' ref='11'/>"
      "<member type='way' role='right' ref='13'/>" +
      tag("type", "lanelet") + tag("subtype", "road") + "</relation></osm>";
  const Road road = load(two_lanes() + deleted);
  EXPECT_EQ(road.lanes.size(), 2u);
  EXPECT_EQ(road.lanes[0].left.front(), Point(0.0, 0.0, 7.0)) << "in local coordinates";
}

TEST_F(MadeUpMap, OneElementThatIsMissingLosesOneLane) {
  for (const std::string element : {"node id='1'", "node id='3'", "node id='4'", "node id='6'", "way id='11'",
                                    "way id='12'", "way id='13'", "way id='14'"}) {
    std::string map = two_lanes();
    const std::size_t at = map.find("<" + element);
    const std::string end = "</" + element.substr(0, element.find(' ')) + ">";
    map.erase(at, map.find(end, at) + end.size() - at);
    EXPECT_EQ(load_rest(map + "</osm>").lanes.size(), 1u) << element;
    EXPECT_NE(left_out.summary().find("a relation that has no way"), std::string::npos) << element;
  }
}

TEST_F(MadeUpMap, OneElementThatAnEditorDeletedLosesOneLane) {
  for (const std::string mark : {"action='delete'", "visible='false'", "action='delete' visible='false'"})
    for (const std::string element : {"relation id='21'", "relation id='22'", "way id='11'", "way id='14'",
                                      "node id='1'", "node id='6'"}) {
      std::string map = two_lanes();
      map.insert(map.find("<" + element) + 1 + element.size(), " " + mark);
      EXPECT_EQ(load_rest(map + "</osm>").lanes.size(), 1u) << element << " " << mark;
      EXPECT_EQ(left_out.empty(), element.starts_with("relation")) << "what hangs on it is told";
    }
}

TEST_F(MadeUpMap, AFileThatIsCutOffIsReadUpToThere) {
  const std::string cut = two_lanes() + "<relation id='30'><member type='w";
  EXPECT_EQ(load_rest(cut).lanes.size(), 2u);
  EXPECT_NE(left_out.summary().find("1 x the rest of the file, which is damaged or cut off (first: byte "),
            std::string::npos);
  EXPECT_NE(error(cut).find(" at byte "), std::string::npos);
  EXPECT_NE(error("").find("is empty; a Lanelet2 map (.osm) is needed"), std::string::npos);
}

}  // namespace
}  // namespace laneloom::simulation
