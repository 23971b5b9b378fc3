#include "simulation/opendrive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "laneloom/polyline.hpp"
#include "road_checks.hpp"
#include "simulation/lanelet2.hpp"
#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::simulation {
namespace {

using testing::HasSubstr;

/// A road of a single lane that is 3 m wide, to the right of the reference line.
std::string road_of(const std::string& geometries, const std::string& lanes = {},
                    const std::string& more = {}) {
  const std::string one_lane =
      R"(<laneSection s="0"><center><lane id="0"><roadMark sOffset="0" type="solid"/></lane></center><right>)"
      R"(<lane id="-1" type="driving"><width sOffset="0" a="3"/><roadMark sOffset="0" type="broken"/></lane>)"
      R"(</right></laneSection>)";
  return R"(<road id="7" junction="-1"><planView>)" + geometries + "</planView><lanes>" +
         (lanes.empty() ? one_lane : lanes) + "</lanes>" + more + "</road>";
}

std::string geometry(double length_m, const std::string& shape, double s_m = 0.0, double heading_rad = 0.0) {
  return R"(<geometry s=")" + std::to_string(s_m) + R"(" x="10" y="20" hdg=")" + std::to_string(heading_rad) +
         R"(" length=")" + std::to_string(length_m) + R"(">)" + shape + "</geometry>";
}

class OpenDrive : public testing::Test {
 protected:
  Road load(const std::string& roads, bool strict = true) {
    return load_file("<OpenDRIVE>" + roads + "</OpenDRIVE>", strict);
  }
  Road load_file(const std::string& content, bool strict = true) {
    std::ofstream(folder_.file("road.xodr"), std::ios::binary) << content;
    left_out_ = LeftOut(strict);
    return load_opendrive(folder_.file("road.xodr"), 10.0, left_out_);
  }
  /// The end of the reference line, in the frame of its begin.
  Point end_of(double length_m, const std::string& shape) {
    const Road road = load(road_of(geometry(length_m, shape)));
    return road.lanes.at(0).left.back() - Point(10.0, 20.0, 0.0);
  }
  std::string error(const std::string& roads) {
    return thrown_by([&] { load(roads); });
  }
  std::string left_out() const { return left_out_.summary(); }

 private:
  TemporaryFolder folder_;
  LeftOut left_out_;
};

void expect_near(const Point& point, double x, double y, double tolerance_m = 1e-3) {
  EXPECT_NEAR(point.x(), x, tolerance_m);
  EXPECT_NEAR(point.y(), y, tolerance_m);
}

TEST_F(OpenDrive, EveryGeometryLeadsWhereItShould) {
  expect_near(end_of(40.0, "<line/>"), 40.0, 0.0);
  const double quarter_m = 0.5 * std::numbers::pi * 30.0;
  expect_near(end_of(quarter_m, R"(<arc curvature="0.0333333333333"/>)"), 30.0, 30.0);
  expect_near(end_of(quarter_m, R"(<arc curvature="-0.0333333333333"/>)"), 30.0, -30.0);
  // The series of the clothoid, by the heading at its end.
  const double length_m = 15.0, turn = 0.5 * 0.05 * length_m, turn2 = turn * turn;
  expect_near(end_of(length_m, R"(<spiral curvStart="0" curvEnd="0.05"/>)"),
              length_m * (1.0 - turn2 / 10.0 + turn2 * turn2 / 216.0),
              length_m * (turn / 3.0 - turn * turn2 / 42.0 + turn * turn2 * turn2 / 1320.0));
  // A parabola y = x²/100 up to x = 30, along which x = 30 is at this length.
  const double k = 0.02, slope = 30.0 * k;
  const double parabola_m = (slope * std::hypot(1.0, slope) + std::asinh(slope)) / (2.0 * k);
  expect_near(end_of(parabola_m, R"(<poly3 a="0" b="0" c="0.01" d="0"/>)"), 30.0, 9.0, 0.02);
  expect_near(end_of(33.0, R"(<paramPoly3 aU="0" bU="30" cU="0" dU="0" aV="0" bV="0" cV="9" dV="0"/>)"), 30.0,
              9.0);
  expect_near(
      end_of(
          33.0,
          R"(<paramPoly3 pRange="arcLength" aU="0" bU="1" cU="0" dU="0" aV="0" bV="0" cV="0.01" dV="0"/>)"),
      33.0, 10.89);
}

TEST_F(OpenDrive, LanesHaveWidthsBordersOffsetsAndDirections) {
  const std::string lanes =
      R"(<laneOffset s="0" a="0.5"/><laneSection s="0">)"
      R"(<left><lane id="1" type="driving"><width sOffset="0" a="3"/></lane></left><center><lane id="0"/></center>)"
      R"(<right><lane id="-1" type="driving"><width sOffset="0" a="2" b="0.05"/></lane>)"
      R"(<lane id="-2" type="sidewalk"><width sOffset="0" a="2"/></lane></right></laneSection>)"
      R"(<laneSection s="20"><center><lane id="0"/></center><right>)"
      R"(<lane id="-1" type="driving"><border sOffset="0" a="-3"/></lane></right></laneSection>)";
  const Road road = load(road_of(geometry(40.0, "<line/>"), lanes));
  ASSERT_EQ(road.lanes.size(), 3u);
  const RoadLane &left = road.lanes[0], &right = road.lanes[1], &border = road.lanes[2];
  expect_near(left.left.front(), 30.0, 20.5);  // it is driven against the reference line
  expect_near(left.right.front(), 30.0, 23.5);
  expect_near(right.left.front(), 10.0, 20.5);
  expect_near(right.right.front(), 10.0, 18.5);
  expect_near(right.right.back(), 30.0, 17.5);
  expect_near(border.right.back(), 50.0, 17.5);
  EXPECT_EQ(right.successors, std::vector<ElementId>{3});
  for (const RoadLane& lane : road.lanes) expect_left_is_left(lane);
  // Edges: beyond the left lane, and between the right lane and the sidewalk.
  EXPECT_NE(left.right_marking, kNoElement);
  EXPECT_NE(right.right_marking, kNoElement);
  EXPECT_EQ(right.left_marking, kNoElement);
}

TEST_F(OpenDrive, SectionsMayComeInAnyOrder) {
  const auto section = [](const std::string& s_m, const std::string& width) {
    return R"(<laneSection s=")" + s_m + R"("><center><lane id="0"/></center><right>)" +
           R"(<lane id="-1" type="driving"><width sOffset="0" a=")" + width +
           R"("/></lane></right></laneSection>)";
  };
  const std::string first = section("0", "3"), second = section("15", "4"), third = section("30", "5");
  const Road road = load(road_of(geometry(40.0, "<line/>"), third + first + second));
  ASSERT_EQ(road.lanes.size(), 3u);
  expect_near(road.lanes[0].right.front(), 10.0, 17.0);
  expect_near(road.lanes[1].right.front(), 25.0, 16.0);
  expect_near(road.lanes[2].right.back(), 50.0, 15.0);
}

TEST_F(OpenDrive, ARoadThatIsGivenTwiceIsTakenOnce) {
  const std::string road = road_of(geometry(40.0, "<line/>"));
  EXPECT_EQ(load(road + road, false).lanes.size(), 1u);
  EXPECT_EQ(left_out(), "1 x a road that is given twice (first: road 7)");
  std::string nameless = road;
  nameless.erase(nameless.find(R"(id="7")"), 6);
  EXPECT_EQ(load(nameless + nameless).lanes.size(), 2u) << "roads without an id may be two";
}

TEST_F(OpenDrive, TheRuleOfARoadTellsTheSideOfTraffic) {
  std::string text = road_of(geometry(40.0, "<line/>"));
  EXPECT_TRUE(load(text).right_hand_traffic);
  text.insert(text.find("id="), R"(rule="LHT" )");
  const Road road = load(text);
  EXPECT_FALSE(road.right_hand_traffic);
  expect_near(road.lanes.at(0).right.front(), 50.0,
              20.0);  // driven against, with the centre line to its right
  expect_left_is_left(road.lanes[0]);
}

TEST_F(OpenDrive, ALaneMayBeDrivenTheOtherWay) {
  std::string text = road_of(geometry(40.0, "<line/>"));
  const std::string lane = R"(<lane id="-1" )";
  text.insert(text.find(lane) + lane.size(), R"(direction="reversed" )");
  const Road road = load(text);
  ASSERT_EQ(road.lanes.size(), 1u);
  expect_near(road.lanes[0].left.front(), 50.0, 17.0);
  expect_near(road.lanes[0].left.back(), 10.0, 17.0);
  expect_left_is_left(road.lanes[0]);
}

/// A lane section of a single side, whose lane has a mark 5 m behind its begin.
std::string one_side(const std::string& s_m, const std::string& side, const std::string& id,
                     const std::string& width) {
  return R"(<laneSection s=")" + s_m + R"(" singleSide="true"><center><lane id="0"/></center><)" + side +
         R"(><lane id=")" + id + R"(" type="driving"><width sOffset="0" )" + width +
         R"(/><roadMark sOffset="5" type="solid"/></lane></)" + side + "></laneSection>";
}

TEST_F(OpenDrive, SectionsOfASingleSideLeaveTheOtherSideAsItIs) {
  const Road at_once = load(road_of(geometry(40.0, "<line/>"), one_side("0", "right", "-1", R"(a="3")") +
                                                                   one_side("0", "left", "1", R"(a="4")")));
  ASSERT_EQ(at_once.lanes.size(), 2u);
  expect_near(at_once.lanes[0].right.front(), 50.0, 24.0);
  expect_near(at_once.lanes[1].right.front(), 10.0, 17.0);

  const Road later =
      load(road_of(geometry(40.0, "<line/>"), one_side("0", "right", "-1", R"(a="3" b="0.1")") +
                                                  one_side("20", "left", "1", R"(a="4")")));
  ASSERT_EQ(later.lanes.size(), 3u);
  expect_near(later.lanes[0].right.back(), 30.0, 15.0);
  expect_near(later.lanes[2].right.back(), 50.0, 13.0);  // its width goes on, and does not begin anew
  EXPECT_EQ(later.lanes[0].successors, std::vector<ElementId>{later.lanes[2].id});
  double marks_m = 0.0;
  for (const RoadMarking& mark : later.markings)
    if (mark.type == MarkingType::laneline) marks_m += mark.points.back().x() - mark.points.front().x();
  EXPECT_NEAR(marks_m, 35.0 + 15.0, 1e-6) << "the mark on the right is not anew 5 m behind the section";
}

TEST_F(OpenDrive, MarksHaveTypesAndStyles) {
  const std::string lanes =
      R"(<laneSection s="0"><center><lane id="0"><roadMark sOffset="0" type="solid solid"/>)"
      R"(<roadMark sOffset="10" type="none"/><roadMark sOffset="20" type="broken solid"/></lane></center><right>)"
      R"(<lane id="-1" type="driving"><width sOffset="0" a="3"/><roadMark sOffset="0" type="broken"/></lane>)"
      R"(<lane id="-2" type="shoulder"><width sOffset="0" a="1"/><roadMark sOffset="0" type="curb"/></lane>)"
      R"(</right></laneSection>)";
  const std::string stop =
      R"(<objects><object type="roadMark" name="StopLine" s="30" t="-1.5" hdg="0" width="3" length="0.4"/>)"
      R"(<object type="tree" s="3" t="9"/></objects>)";
  const Road road = load(road_of(geometry(40.0, "<line/>"), lanes, stop));
  std::vector<std::tuple<MarkingType, MarkingStyle, double>> marks;
  for (const RoadMarking& mark : road.markings)
    marks.emplace_back(mark.type, mark.style, length(mark.points));
  using enum MarkingType;
  using enum MarkingStyle;
  EXPECT_THAT(marks, testing::UnorderedElementsAre(
                         std::tuple(laneline, solid, 10.0), std::tuple(laneline, unknown, 20.0),
                         std::tuple(laneline, dashed, 40.0), std::tuple(roadedge, solid, 40.0),
                         std::tuple(roadedge, solid,
                                    11.0),  // where the centre line, the side of the road, has no mark

                         std::tuple(stopline, solid, 3.0)));
}

/// A road of a lane whose right border has these marks, each with its offset.
std::string road_with_marks(const std::vector<std::pair<double, std::string>>& marks) {
  std::string text;
  for (const auto& [offset_m, type] : marks)
    text += R"(<roadMark sOffset=")" + std::to_string(offset_m) + R"(" type=")" + type + R"("/>)";
  return road_of(geometry(40.0, "<line/>"),
                 R"(<laneSection s="0"><center><lane id="0"/></center><right><lane id="-1" type="driving">)"
                 R"(<width sOffset="0" a="3"/>)" +
                     text + "</lane></right></laneSection>");
}

TEST_F(OpenDrive, MarksChangeWhereTheFileSays) {
  const Road road = load(road_with_marks({{0.0, "solid"}, {13.4, "broken"}, {31.7, "curb"}}));
  std::vector<std::pair<double, double>> marks;
  for (const RoadMarking& mark : road.markings)
    if (mark.points.front().y() < 19.0)
      marks.emplace_back(mark.points.front().x() - 10.0, mark.points.back().x() - 10.0);
  const auto from_to = [](double from_m, double to_m) {
    return testing::Pair(testing::DoubleNear(from_m, 1e-6), testing::DoubleNear(to_m, 1e-6));
  };
  EXPECT_THAT(marks, testing::ElementsAre(from_to(0.0, 13.4), from_to(13.4, 31.7), from_to(31.7, 40.0)));
  ASSERT_EQ(road.lanes.size(), 1u);
  const ElementId marking = road.lanes[0].right_marking;
  ASSERT_NE(marking, kNoElement) << "the border is marked all along";
  EXPECT_EQ(road.markings.at(marking - 1).style, MarkingStyle::dashed)
      << "by the broken mark for the most part";
}

TEST_F(OpenDrive, MarksThatAreShorterThanAMetreAreThere) {
  std::vector<std::pair<double, std::string>> dots;
  for (int i = 0; i < 10; ++i) {
    dots.emplace_back(4.0 * i + 0.3, "solid");
    dots.emplace_back(4.0 * i + 1.1, "none");
  }
  double painted_m = 0.0;
  for (const RoadMarking& mark : load(road_with_marks(dots)).markings)
    if (mark.type == MarkingType::laneline) painted_m += length(mark.points);
  EXPECT_NEAR(painted_m, 8.0, 1e-6);
}

TEST_F(OpenDrive, RoadsOfAJunctionThatLieOnOneAnotherShareTheirMarks) {
  std::string marked = road_of(geometry(40.0, "<line/>"));
  marked.replace(marked.find(R"("-1")"), 4, R"("5")");
  std::string plain = marked;
  plain.replace(plain.find(R"(id="7")"), 6, R"(id="8")");
  plain.replace(plain.find("broken"), 6, "none");
  const Road road = load(marked + plain);
  ASSERT_EQ(road.lanes.size(), 2u);
  EXPECT_NE(road.lanes[1].right_marking, kNoElement);
  EXPECT_EQ(road.lanes[1].right_marking, road.lanes[0].right_marking);
}

/// A lane with a mark on its outer border.
std::string lane(int id, const std::string& type, double width_m, const std::string& mark) {
  return R"(<lane id=")" + std::to_string(id) + R"(" type=")" + type + R"("><width sOffset="0" a=")" +
         std::to_string(width_m) + R"("/><roadMark sOffset="0" type=")" + mark + R"("/></lane>)";
}

TEST_F(OpenDrive, TheMarkBesideAnUnpavedLaneIsThere) {
  // From the centre: a median, a driving lane, its narrow shoulder, a verge, and grass. A lane without width
  // is at the border of the median.
  const std::string lanes = R"(<laneSection s="0"><center><lane id="0"/></center><right>)" +
                            lane(-1, "median", 2.0, "solid") + lane(-2, "border", 0.0, "curb") +
                            lane(-3, "driving", 3.0, "broken") + lane(-4, "shoulder", 0.3, "solid") +
                            lane(-5, "border", 1.0, "solid") + lane(-6, "none", 1.0, "solid") +
                            "</right></laneSection>";
  const Road road = load(road_of(geometry(40.0, "<line/>"), lanes));
  std::vector<std::pair<double, MarkingStyle>> marks;  // by their place to the right of the centre line
  for (const RoadMarking& mark : road.markings)
    if (mark.type == MarkingType::laneline) marks.emplace_back(20.0 - mark.points.front().y(), mark.style);
  using enum MarkingStyle;
  EXPECT_THAT(marks, testing::UnorderedElementsAre(testing::Pair(testing::DoubleNear(2.0, 1e-6), solid),
                                                   testing::Pair(testing::DoubleNear(5.0, 1e-6), dashed),
                                                   testing::Pair(testing::DoubleNear(5.3, 1e-6), solid)));
  ASSERT_EQ(road.lanes.size(), 1u);
  EXPECT_NE(road.lanes[0].left_marking, kNoElement);
}

TEST_F(OpenDrive, AMapOfWhichNothingCanBeSeenIsRefused) {
  std::string map = road_of(geometry(40.0, "<line/>"));
  for (const std::string type : {R"("solid")", R"("broken")"})
    map.replace(map.find(type), type.size(), R"("none")");
  EXPECT_EQ(load(map).lanes.size(), 1u) << "it has edges";
  map.replace(map.find(R"("-1")"), 4, R"("5")");  // in a junction, where there are none
  EXPECT_THAT(error(map), HasSubstr("road.xodr: has no road marks, and no edges"));
}

TEST_F(OpenDrive, WhatIsWrongIsLeftOutWithItsRoad) {
  std::string good = road_of(geometry(40.0, "<line/>"));
  good.replace(good.find(R"(id="7")"), 6, R"(id="1")");
  const std::vector<std::pair<std::string, std::string>> bad{
      {road_of(""), "has no geometry"},
      {road_of(geometry(40.0, "<bezier/>")), "that is no line, arc, spiral, poly3 or paramPoly3"},
      {road_of(geometry(-1.0, "<line/>")), "has a geometry of such a length"},
      {road_of(geometry(2e5, "<line/>")), "has a geometry of such a length"},
      {road_of(geometry(40.0, R"(<arc curvature="round"/>)")), "has no number within reach as arc.curvature"},
      {road_of(geometry(40.0, R"(<arc curvature="nan"/>)")), "has no number within reach as arc.curvature"},
      {road_of(geometry(40.0, R"(<arc/>)")), "has no arc.curvature"},
      {road_of(geometry(40.0, R"(<spiral curvStart="0" curvEnd="1e9"/>)")),
       "has no number within reach as spiral.curvEnd"}};
  for (const auto& [road, complaint] : bad) {
    EXPECT_THAT(error(good + road), HasSubstr("road.xodr: road 7: "));
    EXPECT_THAT(error(good + road), HasSubstr(complaint));
    EXPECT_EQ(load(good + road, false).lanes.size(), 1u);
    EXPECT_THAT(left_out(), HasSubstr(complaint));
    EXPECT_THAT(left_out(), HasSubstr("(first: road 7)"));
  }
  EXPECT_THAT(error(""), HasSubstr("has no lanes for vehicles"));
}

TEST_F(OpenDrive, ASecondMapInAFileIsTold) {
  const std::string map = "<OpenDRIVE>" + road_of(geometry(40.0, "<line/>")) + "</OpenDRIVE>";
  EXPECT_EQ(load_file(map + map, false).lanes.size(), 1u);
  EXPECT_EQ(left_out(), "1 x the rest of the file, which is a second map (first: byte " +
                            std::to_string(map.size() + 1) + ")");
  EXPECT_THAT(thrown_by([&] { load_file(map + map); }), HasSubstr("has a second map at byte "));
}

TEST_F(OpenDrive, AFileInUtf16IsRead) {
  const std::string text = "<OpenDRIVE>" + road_of(geometry(40.0, "<line/>")) + "</OpenDRIVE>";
  for (const bool big_endian : {false, true}) {
    std::string utf16 = big_endian ? "\xfe\xff" : "\xff\xfe";
    for (const char letter : text)
      utf16 += big_endian ? std::string{'\0', letter} : std::string{letter, '\0'};
    EXPECT_EQ(load_file(utf16).lanes.size(), 1u);
  }
}

/// The drawn quarter: see tests/roads/README.md.
class Harbour : public testing::Test {
 protected:
  static Road load() {
    LeftOut nothing(/*strict=*/true);
    return load_opendrive(LANELOOM_ROADS "/harbour.xodr", 10.0, nothing);
  }
};

TEST_F(Harbour, LanesMeetAndAreOnTheirSide) {
  const Road road = load();
  EXPECT_FALSE(road.right_hand_traffic);
  EXPECT_EQ(road.lanes.size(), 37u);
  for (const RoadLane& lane : road.lanes) {
    expect_left_is_left(lane);
    expect_successors_meet(road, lane, 1e-3);
    EXPECT_FALSE(lane.successors.empty()) << "lane " << lane.id;
  }
  expect_borders_on_markings(road, 1e-3);
  check_references(road);
}

TEST_F(Harbour, HasTheOdditiesOfRealRoads) {
  const Road road = load();
  double narrowest_m = 10.0, widest_m = 0.0;
  for (const RoadLane& lane : road.lanes) {
    if (lane.in_intersection) continue;
    const double width_m = (lane.left.at(lane.left.size() / 2) - lane.right.at(lane.right.size() / 2)).norm();
    narrowest_m = std::min(narrowest_m, width_m);
    widest_m = std::max(widest_m, width_m);
  }
  EXPECT_NEAR(narrowest_m, 2.6, 0.01);
  EXPECT_NEAR(widest_m, 5.0, 0.01);
  // Two kerbs with the same ends are those of an island.
  std::size_t islands = 0, stops = 0;
  const auto meet = [](const Point& a, const Point& b) { return (a - b).norm() < 1e-3; };
  for (const RoadMarking& kerb : road.markings) {
    stops += kerb.type == MarkingType::stopline ? 1U : 0U;
    for (const RoadMarking& other : road.markings)
      islands += kerb.type == MarkingType::roadedge && other.type == kerb.type && kerb.id < other.id &&
                         length(kerb.points) < 40.0 && meet(kerb.points.front(), other.points.front()) &&
                         meet(kerb.points.back(), other.points.back())
                     ? 1U
                     : 0U;
  }
  EXPECT_EQ(islands, 1u);
  EXPECT_EQ(stops, 1u);
}

TEST_F(Harbour, IsTheSameAsALanelet2Map) {
  const Road xodr = load(), osm = load_lanelet2(LANELOOM_ROADS "/harbour_lanelet2.osm");
  EXPECT_FALSE(osm.right_hand_traffic);
  ASSERT_EQ(osm.lanes.size(), xodr.lanes.size());
  for (std::size_t i = 0; i < osm.lanes.size(); ++i) {
    EXPECT_EQ(osm.lanes[i].successors, xodr.lanes[i].successors) << "lane " << i + 1;
    for (const auto side : {&RoadLane::left, &RoadLane::right}) {
      const MeasuredPolyline line(xodr.lanes[i].*side);
      for (const Point& point : osm.lanes[i].*side) EXPECT_LT(line.project(point).distance_m, 0.02);
    }
  }
  for (const MarkingType type : {MarkingType::laneline, MarkingType::roadedge, MarkingType::stopline}) {
    const auto length_of = [&](const Road& road) {
      double sum_m = 0.0;
      for (const RoadMarking& marking : road.markings)
        if (marking.type == type) sum_m += length(marking.points);
      return sum_m;
    };
    EXPECT_NEAR(length_of(osm), length_of(xodr), 0.02 * length_of(xodr));
  }
}

}  // namespace
}  // namespace laneloom::simulation
