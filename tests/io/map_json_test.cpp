#include <gtest/gtest.h>

#include "io/json_lines.hpp"
#include "thrown_by.hpp"

namespace laneloom::io {
namespace {

LocalMap full_map() {
  LocalMap map;
  map.stamp_ns = 123'456'789'012;
  map.T_map_body = Eigen::Translation3d(10.0, 20.0, 30.0) * Eigen::AngleAxisd(-1.0, Point::UnitZ());
  Marking boundary;
  boundary.id = 4;
  boundary.type = MarkingType::roadedge;
  boundary.status = ElementStatus::tentative;
  boundary.points = {{0.0, 1.0, 2.0}, {3.0, 4.0, 5.0}};
  boundary.styles = {{{0.0, 4.0}, MarkingStyle::dashed}};
  boundary.lateral_stddev_m = {0.1, 0.2};
  boundary.existence_probability = 0.75;
  boundary.observations = 12;
  boundary.first_seen_ns = 99;
  map.boundaries = {boundary};
  Stopline stopline;
  stopline.marking = boundary;
  stopline.marking.id = 5;
  stopline.marking.type = MarkingType::stopline;
  stopline.lanes = {6};
  stopline.heading = {1.0, 0.0, 0.0};
  map.stoplines = {stopline};
  Lane lane;
  lane.id = 6;
  lane.left_borders = {{4, {0.0, 0.5}, {1.0, 2.0}}, {kNoElement, {0.5, 1.5}, {}}};
  lane.right_borders = {{4, {0.0, 1.5}, {4.0, 3.0}}};
  lane.left = lane.right = lane.centerline = boundary.points;
  lane.width_m = 3.25;
  lane.left_neighbours = {{.lane = 7, .range = {0.0, 2.0}, .crossable = {{0.5, 1.0}}}};
  lane.right_neighbours = {{.lane = 8, .range = {0.25, 1.0}, .crossable = {}}};
  lane.direction = Lane::Direction::against_centerline;
  lane.direction_probability = 0.875;
  lane.direction_evidence = Evidence::ego_path | Evidence::sd_map;
  lane.use = Lane::Use::shoulder;
  lane.use_probability = 0.625;
  lane.evidence = Evidence::markings | Evidence::edges;
  lane.section = 3;
  lane.status = ElementStatus::inferred;
  lane.existence_probability = 0.5;
  lane.inferred_ranges = {{0.5, 0.75}};
  map.lanes = {lane};
  map.linkages = {{.from = 6,
                   .to = 7,
                   .kind = Linkage::Kind::intersection,
                   .turn = Linkage::Turn::left,
                   .probability = 0.25,
                   .evidence = Evidence::traffic,
                   .path = boundary.points}};
  const WayStation station{.point = {0.0, 1.0, 2.0},
                           .heading_rad = 0.5,
                           .curvature_per_m = 0.01,
                           .lane = 6,
                           .left_m = 1.5,
                           .status = ElementStatus::inferred,
                           .may_change_left = true};
  map.way = Way{.step_m = 2.0,
                .stations = {station, station},
                .lanes = {{.id = 6, .against = true, .entry = Linkage::Turn::u_turn, .range = {0.0, 2.0}}},
                .known_m = 2.5,
                .confirmed_m = 1.0};
  map.driven_paths = {
      {.id = 9, .points = {{0.0, 0.0, 0.0}, {9.0, 0.0, 0.0}}, .lateral_stddev_m = 0.6, .probability = 0.5}};
  return map;
}

TEST(MapJson, IsReadAsItWasWritten) {
  const std::string line = to_json_line(full_map());
  const LocalMap read = map_from_json(line);
  EXPECT_EQ(read.stamp_ns, 123'456'789'012);
  EXPECT_TRUE(read.T_map_body.isApprox(full_map().T_map_body, 1e-9));
  ASSERT_EQ(read.boundaries.size(), 1u);
  EXPECT_EQ(read.boundaries[0].observations, 12u);
  ASSERT_EQ(read.stoplines.size(), 1u);
  EXPECT_EQ(read.stoplines[0].marking.points, full_map().stoplines[0].marking.points);
  ASSERT_EQ(read.lanes.size(), 1u);
  ASSERT_EQ(read.lanes[0].left_borders.size(), 2u);
  EXPECT_EQ(read.lanes[0].left_borders[1].boundary, kNoElement);
  EXPECT_EQ(read.lanes[0].right_borders.front().on_boundary.from_m, 4.0);
  EXPECT_EQ(read.lanes[0].direction_evidence, Evidence::ego_path | Evidence::sd_map);
  ASSERT_TRUE(read.way);
  EXPECT_EQ(read.way->lanes.at(0).entry, Linkage::Turn::u_turn);
  ASSERT_EQ(read.driven_paths.size(), 1u);
  ASSERT_EQ(read.linkages.size(), 1u);
  EXPECT_EQ(read.linkages[0].turn, Linkage::Turn::left);
  EXPECT_NE(line.find("\"successors\":[7]"), std::string::npos);
  // Whatever else there is comes out again as it went in.
  LocalMap same_pose = read;
  same_pose.T_map_body = full_map().T_map_body;
  EXPECT_EQ(to_json_line(same_pose), line);
}

TEST(MapJson, TakesMapsOfOthersWithSuccessorsOnly) {
  const LocalMap map = map_from_json(
      R"({"t":2,"pose":[0,0,0,0,0,0,1],"instances":[{"id":1,"type":"laneline","points":[[0,0,0],[9,0,0]]}],)"
      R"("lanes":[{"id":3,"left":[[0,0,0]],"right":[],"centerline":[[0,0,0]],"successors":[4,5]}]})");
  EXPECT_EQ(map.boundaries.size(), 1u);
  ASSERT_EQ(map.linkages.size(), 2u);
  EXPECT_EQ(map.linkages[1].from, 3u);
  EXPECT_EQ(map.linkages[1].to, 5u);
}

/// For a map with `from` replaced by `to`.
std::string map_complaint(const std::string& from, const std::string& to) {
  std::string line = to_json_line(full_map());
  line.replace(line.find(from), from.size(), to);
  return thrown_by([&] { map_from_json(line); });
}

TEST(MapJson, WhatIsWrongIsNamed) {
  EXPECT_EQ(map_complaint(R"("turn":"left")", R"("turn":"back")"), "linkages[0].turn: 'back' is not known");
  EXPECT_EQ(map_complaint(R"("probability":0.25)", R"("probability":1.5)"),
            "linkages[0].probability: must be from 0 to 1");
  EXPECT_EQ(map_complaint(R"("evidence":["traffic"])", R"("evidence":["hearsay"])"),
            "linkages[0].evidence: 'hearsay' is not known");
  EXPECT_EQ(map_complaint(R"("step":2.0)", R"("step":0.0)"),
            "way: must have two stations at least, and a step above 0");
  EXPECT_EQ(map_complaint(R"("existence":0.75)", R"("existence":1e300)"),
            "instances[0].existence: must be from 0 to 1, or -1");
  EXPECT_EQ(map_complaint(R"("existence":0.5)", R"("existence":-0.5)"),
            "lanes[0].existence: must be from 0 to 1, or -1");
  EXPECT_EQ(map_complaint(R"("existence":0.5)", R"("existence":-1)"), "");
  EXPECT_EQ(map_complaint("[3.0,4.0,5.0]", "[3.0,1e308,5.0]"), "instances[0].points[1]: is too far away");
  EXPECT_EQ(map_complaint("[3.0,4.0,5.0]", "[3.0,9e6,5.0]"),
            "a lane has no points, or a line is longer than 100 km or further from the vehicle");
}

}  // namespace
}  // namespace laneloom::io
