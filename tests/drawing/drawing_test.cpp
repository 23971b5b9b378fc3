#include "drawing/drawing.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "drawing/frame_elements.hpp"
#include "drawing/map_elements.hpp"
#include "drawing/marking_shapes.hpp"
#include "drawing/traffic_elements.hpp"
#include "drawing/truth.hpp"
#include "small_map.hpp"

namespace laneloom::drawing {
namespace {

const Element& element(const Drawing& drawing, std::string_view key) {
  const auto& all = drawing.elements();
  const auto found = std::ranges::find(all, key, &Element::key);
  if (found == all.end()) throw std::runtime_error("no element " + std::string(key));
  return *found;
}

template <class Form>
std::vector<Form> forms(const Element& element) {
  std::vector<Form> out;
  for (const Shape& shape : element.shapes)
    if (const auto* form = std::get_if<Form>(&shape.form)) out.push_back(*form);
  return out;
}

Drawing everything(const LocalMap& map) {
  Drawing drawing;
  add_ids(map, drawing);
  add_vehicle(map.T_map_body, drawing);
  add_map(map, drawing);
  add_markings(map, drawing);
  add_uncertainty(map, drawing);
  add_range({}, map.T_map_body, drawing);
  return drawing;
}

TEST(Drawing, IsInTheOrderOfPaintingWithKeysOfItsOwn) {
  const Drawing drawing = everything(small_map());
  std::set<std::string> keys;
  for (const Element& element : drawing.elements()) {
    EXPECT_TRUE(keys.insert(element.key).second) << element.key;
    EXPECT_FALSE(element.shapes.empty()) << element.key;
  }
  EXPECT_TRUE(std::ranges::is_sorted(drawing.elements(), {}, &Element::layer));
  EXPECT_EQ(drawing.elements().front().key, "lanes/21");
  EXPECT_EQ(drawing.elements().back().key, "vehicle");
  EXPECT_EQ(drawing.stamp_ns, 10'000'000'000);
}

TEST(Drawing, MarkingsHaveALineForEachStretchOfAStyle) {
  const Drawing drawing = everything(small_map());
  const Element& left = element(drawing, "boundaries/11");
  EXPECT_EQ(left.id, 11u);
  EXPECT_EQ(left.type, "laneline");
  ASSERT_EQ(left.shapes.size(), 2u);
  EXPECT_EQ(left.shapes[0].style, Style::laneline_solid);
  EXPECT_EQ(left.shapes[1].style, Style::laneline_dashed);
  EXPECT_DOUBLE_EQ(left.shapes[0].opacity, 0.65);
  EXPECT_EQ(forms<DrawnLine>(left)[1].points, (Polyline{{4, 1.75, 0}, {5, 1.75, 0}, {10, 1.75, 0}}));
  const Element& right = element(drawing, "boundaries/12");
  EXPECT_EQ(right.status, ElementStatus::tentative);
  EXPECT_EQ(right.shapes.at(0).style, Style::roadedge);
  EXPECT_DOUBLE_EQ(right.shapes[0].opacity, 1.0);
}

TEST(Drawing, LanesAreAreasWithArrowsTheWayThatTrafficRuns) {
  const Drawing drawing = everything(small_map());
  const Element& lane = element(drawing, "lanes/21");
  ASSERT_EQ(forms<DrawnArea>(lane).size(), 1u);
  EXPECT_EQ(forms<DrawnArea>(lane)[0].right, (Polyline{{0, -1.75, 0}, {10, -1.75, 0}}));
  ASSERT_EQ(forms<DrawnArrow>(lane).size(), 1u);
  EXPECT_TRUE(forms<DrawnArrow>(lane)[0].direction.isApprox(Point(-1, 0, 0)));
  EXPECT_TRUE(forms<DrawnArrow>(lane)[0].tip.isApprox(Point(5, 0, 0)));
  // Not known which way: fainter, as the points run.
  const Element& next = element(drawing, "lanes/22");
  EXPECT_TRUE(forms<DrawnArea>(next).empty());
  EXPECT_TRUE(forms<DrawnArrow>(next).at(0).direction.isApprox(Point(1, 0, 0)));
  EXPECT_LT(next.shapes.back().opacity, lane.shapes.back().opacity);
  EXPECT_NE(next.shapes.back().style, lane.shapes.back().style);
}

TEST(Drawing, LinkagesPointIntoTheLaneThatContinues) {
  const Element linkage = element(everything(small_map()), "linkages/21-22");
  EXPECT_EQ(forms<DrawnLine>(linkage).at(0).points.front(), Point(6.5, 0, 0));
  EXPECT_EQ(forms<DrawnArrow>(linkage).at(0).tip, Point(15.5, 0, 0));
}

TEST(Drawing, UncertaintyIsABandAroundTheLine) {
  const Drawing drawing = everything(small_map());
  const auto band = forms<DrawnArea>(element(drawing, "uncertainty/11")).at(0);
  ASSERT_EQ(band.left.size(), 3u);
  EXPECT_TRUE(band.left[2].isApprox(Point(10, 2.35, 0)));
  EXPECT_TRUE(band.right[0].isApprox(Point(0, 1.55, 0)));
  EXPECT_THROW(element(drawing, "uncertainty/12"), std::runtime_error);  // not estimated
}

TEST(Drawing, IdsAreTextsWhereTheElementsAre) {
  const auto text = forms<DrawnText>(element(everything(small_map()), "ids/lane/21")).at(0);
  EXPECT_EQ(text.text, "21");
  EXPECT_TRUE(text.position.isApprox(Point(5, 0, 0)));
}

TEST(Drawing, ElementsWithoutExtentAreLeftOut) {
  LocalMap map;
  map.boundaries.emplace_back();
  map.boundaries.emplace_back().points.resize(1, Point::Zero());
  map.boundaries.emplace_back().points.resize(3, Point(1, 1, 1));
  map.lanes.emplace_back();
  map.linkages.emplace_back();
  map.stoplines.emplace_back();
  Drawing drawing;
  add_map(map, drawing);
  add_markings(map, drawing);
  add_uncertainty(map, drawing);
  add_ids(map, drawing);
  EXPECT_TRUE(drawing.elements().empty());
}

TEST(Drawing, FramesAreTakenToTheMapFrame) {
  DetectionFrame frame;
  frame.sequence = 5;
  frame.detections = {{MarkingType::roadedge, MarkingStyle::solid, 0.5, {{1, 2, 3}, {4, 2, 3}}, {}}};
  frame.field_of_view = {{0, 0, 0}, {30, 10, 0}, {30, -10, 0}};
  frame.occluded_areas = {{{10, 0, 0}, {20, 3, 0}, {20, -3, 0}}, {}};
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  T_map_body.translate(Point(10, 20, 30));
  Drawing drawing;
  add_detections(frame, T_map_body, drawing);
  add_view(frame, T_map_body, drawing);
  ASSERT_EQ(drawing.elements().size(), 3u);
  const Element& detection = element(drawing, "detections/0");
  EXPECT_EQ(detection.type, "roadedge");
  EXPECT_EQ(detection.properties["frame"], 5);
  EXPECT_DOUBLE_EQ(detection.shapes.at(0).opacity, 0.65);
  EXPECT_TRUE(forms<DrawnLine>(detection).at(0).points.at(0).isApprox(Point(11, 22, 33)));
  EXPECT_TRUE(
      forms<DrawnArea>(element(drawing, "field_of_view")).at(0).left.at(1).isApprox(Point(40, 30, 30)));
  EXPECT_EQ(element(drawing, "occlusions/0").layer, Layer::occlusions);
}

TEST(Drawing, TruthLiesBeneathAsThinLines) {
  simulation::Road truth;
  truth.markings = {{.id = 3, .style = MarkingStyle::dashed, .points = {{0, 0, 0}, {5, 0, 0}}}};
  Drawing drawing;
  add_truth(truth, drawing);
  const Element& line = element(drawing, "truth/3");
  EXPECT_EQ(line.shapes.at(0).style, Style::truth);
  EXPECT_EQ(line.properties["style"], "dashed");
}

TEST(LinkagePath, LeadsFromEndToBeginWhateverWayTrafficRuns) {
  Lane from, to;
  from.centerline = {{0, 0, 0}, {10, 0, 0}};
  to.centerline = {{12, 0, 0}, {20, 0, 0}};
  const Polyline expected{{6.5, 0, 0}, {10, 0, 0}, {11, 1, 0}, {12, 0, 0}, {15.5, 0, 0}};
  for (const auto direction : {Lane::Direction::along_centerline, Lane::Direction::against_centerline}) {
    from.direction = to.direction = direction;
    EXPECT_EQ(linkage_path({.path = {{11, 1, 0}}}, from, to), expected);
  }
}

TEST(Traffic, ObjectsAreBoxesOfTheirSizeWhereTheyAre) {
  const TrackedObjects objects{.session_id = 3,
                               .objects = {{.id = 7,
                                            .kind = ObjectKind::truck,
                                            .existence_probability = 0.5,
                                            .position = {10, 2, 0},
                                            .heading = {0, 1, 0},
                                            .speed_mps = 8.0,
                                            .length_m = 6.0,
                                            .width_m = 2.0},
                                           {.id = 8, .position = {5, 0, 0}}}};
  Drawing drawing;
  add_objects(objects, Eigen::Isometry3d(Eigen::Translation3d(100, 0, 0)), drawing);
  const Element& truck = element(drawing, "traffic/3/object/7");
  EXPECT_EQ(truck.type, "truck");
  EXPECT_EQ(truck.properties["speed_mps"], 8.0);
  EXPECT_EQ(truck.shapes.at(0).opacity, opacity_of(0.5));
  EXPECT_EQ(forms<DrawnArea>(truck).at(0).left,
            (Polyline{{109, 5, 0}, {111, 5, 0}, {111, -1, 0}, {109, -1, 0}}));
  const Element& unknown = element(drawing, "traffic/3/object/8");
  EXPECT_FALSE(unknown.properties.contains("length_m"));
  EXPECT_EQ(forms<DrawnArea>(unknown).at(0).left.at(0), Point(105.5, 0.5, 0)) << "a small square";
}

TEST(Traffic, TrailsTellInWhichLanesTheyWereDriven) {
  LocalMap map = small_map();
  map.lanes[0].direction_evidence = Evidence::ego_path | Evidence::traffic;
  std::vector<trails::Trail> trails(4, {.session = 3, .object = 7});
  trails[0].points = {{9, 0, 0}, {6, 0, 0}, {3, 0, 0}, {0, 0, 0}};
  trails[1].points = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}};  // too short
  trails[2].points = {{0, 0, 0}};                        // no line
  trails[3].object = 8;
  trails[3].points = {{3, -9, 0}, {3, 9, 0}};  // across
  Drawing drawing;
  add_trails(trails, map, drawing);
  EXPECT_EQ(drawing.elements().size(), 4U);
  const Element& along = element(drawing, "traffic/3/trail/7/0");
  EXPECT_EQ(along.properties["drove"], nlohmann::json::parse(R"([{"lane": 21, "along_m": -9.0}])"));
  EXPECT_EQ(forms<DrawnArrow>(along).at(0).direction, Point(-1, 0, 0));
  EXPECT_FALSE(element(drawing, "traffic/3/trail/7/1").properties.contains("drove"));
  EXPECT_FALSE(element(drawing, "traffic/3/trail/8/0").properties.contains("drove"));
  // Traffic runs against the points of the lane: so do the arrows. No trail tells of the other lane.
  const Element& told = element(drawing, "traffic/21");
  EXPECT_EQ(told.shapes.at(0).style, Style::told);
  EXPECT_EQ(forms<DrawnArrow>(told).at(0).direction, Point(-1, 0, 0));
}

}  // namespace
}  // namespace laneloom::drawing
