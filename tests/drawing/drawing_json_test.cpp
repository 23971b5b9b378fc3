#include "drawing/drawing_json.hpp"

#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "drawing/map_elements.hpp"
#include "small_map.hpp"

namespace laneloom::drawing {
namespace {

using nlohmann::json;

json drawn(const LocalMap& map) {
  Drawing drawing;
  add_map(map, drawing);
  add_uncertainty(map, drawing);
  add_ids(map, drawing);
  return json::parse(to_json(drawing).dump());
}

json element(const json& drawing, const std::string& key) {
  for (const json& element : drawing["elements"])
    if (element["key"] == key) return element;
  throw std::runtime_error("no element " + key);
}

TEST(DrawingJson, HasStampPoseAndLineage) {
  LocalMap map = small_map();
  map.stamp_ns = 1'700'000'000'123'456'789;
  map.T_map_body.translate(Point(1.004, 2.006, 3));
  map.T_map_body.rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Point::UnitZ()));
  const json drawing = drawn(map);
  EXPECT_EQ(drawing["stamp_ns"], "1700000000123456789");
  EXPECT_EQ(drawing["pose"], json({1.0, 2.01, 1.571}));
  EXPECT_EQ(drawing["lineage"],
            json::parse(R"([{"kind": "merged_into", "element": "boundary", "id": 9, "other": 11},
                                                  {"kind": "split_from", "element": "lane", "id": 22, "other": 21}])"));
}

TEST(DrawingJson, ElementsTellWhatIsKnownOfThem) {
  const json drawing = drawn(small_map());
  EXPECT_EQ(element(drawing, "boundaries/11"), json::parse(R"({
    "layer": "boundaries", "key": "boundaries/11", "id": 11, "type": "laneline", "status": "confirmed",
    "properties": {"age_s": 2.0, "unseen_s": 0.5, "existence_probability": 0.5, "observations": 7,
                   "length_m": 10.0, "lateral_stddev_mean_m": 0.2, "lateral_stddev_max_m": 0.3,
                   "styles": [[0.0, 4.0, "solid"], [4.0, 10.0, "dashed"]], "left_border_of": [21],
                   "lineage": [{"kind": "merged_into", "element": "boundary", "id": 9, "other": 11}]},
    "shapes": [{"line": [0.0, 1.75, 4.0, 1.75], "style": "laneline_solid", "opacity": 0.65},
               {"line": [4.0, 1.75, 5.0, 1.75, 10.0, 1.75], "style": "laneline_dashed", "opacity": 0.65}]})"));
  EXPECT_EQ(element(drawing, "lanes/21")["properties"], json::parse(R"({
    "left_borders": [{"boundary": 11, "range_m": [0.0, 10.0], "on_boundary_m": [0.0, 10.0]}],
    "right_borders": [{"boundary": 12, "range_m": [0.0, 6.0], "on_boundary_m": [0.0, 6.0]},
                      {"boundary": 0, "range_m": [6.0, 10.0]}],
    "use": "lane", "evidence": ["markings", "edges"], "width_m": 3.5, "length_m": 10.0,
    "direction": "against", "direction_probability": 0.9, "direction_evidence": ["ego_path"],
    "section": 0, "left_neighbours": [{"lane": 22, "range_m": [0.0, 10.0], "crossable_m": [[4.0, 10.0]]}],
    "right_neighbours": [], "role": "own lane", "successors": [22], "stoplines": [13],
    "lineage": [{"kind": "split_from", "element": "lane", "id": 22, "other": 21}]})"));
  EXPECT_EQ(element(drawing, "lanes/22")["properties"]["predecessors"], json({21}));
  EXPECT_EQ(element(drawing, "linkages/21-22")["properties"], json::parse(R"({
    "from": 21, "to": 22, "kind": "ego_track", "turn": "left", "probability": 1.0, "evidence": []})"));
  EXPECT_EQ(element(drawing, "way")["properties"], json::parse(R"({
    "length_m": 1.5, "confirmed_m": 1.0, "width_m": 3.5, "lanes": [21]})"));
  EXPECT_EQ(element(drawing, "driven path/31")["properties"], json::parse(R"({
    "length_m": 5.0, "probability": 0.85, "lateral_stddev_m": 0.6})"));
  EXPECT_EQ(element(drawing, "driven path/31")["shapes"][0]["line"], json({20.0, 0.0, 24.0, 3.0}));
  EXPECT_EQ(element(drawing, "stoplines/13")["properties"]["lanes"], json({21}));
  EXPECT_EQ(element(drawing, "stoplines/13")["properties"]["heading"], json({1.0, 0.0}));
}

TEST(DrawingJson, ShapesAreFlatListsOfCentimetres) {
  LocalMap map = small_map();
  map.lanes[0].centerline = {{0.0012, 0.0043, 7}, {10.1251, 0.0051, 7}};
  const json shapes = element(drawn(map), "lanes/21")["shapes"];
  EXPECT_EQ(shapes[0]["area"], json({0.0, 1.75, 5.0, 1.75, 10.0, 1.75, 10.0, -1.75, 0.0, -1.75}));
  EXPECT_EQ(shapes[1]["line"], json({10.13, 0.01, 0.0, 0.0}));
  EXPECT_EQ(shapes[2]["arrow"], json({5.06, 0.0, -3.142}));
  EXPECT_EQ(element(drawn(small_map()), "ids/lane/21")["shapes"][0],
            json::parse(R"({"text": "21", "at": [5.0, 0.0], "style": "id"})"));
}

TEST(DrawingJson, PaletteHasEveryStyleAndLayerOnce) {
  const json palette = palette_json();
  EXPECT_EQ(palette["styles"].size(), kStyleCount);
  std::set<std::string> names;
  for (const json& layer : palette["layers"]) names.insert(layer["name"]);
  EXPECT_EQ(names.size(), kLayerCount);
  EXPECT_EQ(palette["layers"][0]["name"], "field_of_view");
  EXPECT_EQ(palette["styles"]["laneline_dashed"], json::parse(R"({
    "light": "#d41217ff", "dark": "#ff6661ff", "width": 2.2, "dash": [9.0, 7.0]})"));
  EXPECT_EQ(palette["styles"]["course_own"]["head"], 9.0);
  for (const json& layer : palette["layers"])
    EXPECT_TRUE(palette["styles"].contains(layer["sample"])) << layer["name"];
  for (const json& entry : palette["legend"])
    EXPECT_TRUE(palette["styles"].contains(entry["style"])) << entry["title"];
  EXPECT_EQ(palette["dark"]["text"], "#e6e6ebff");
}

/// A style's name belongs to its colours: the order of the tables is that of the enumerators.
TEST(Palette, StylesAreWhatTheyAreCalled) {
  using palette::of;
  EXPECT_STREQ(palette::of(Style::laneline_unknown).name, "laneline_unknown");
  EXPECT_STREQ(palette::of(Style::stopline).name, "stopline");
  EXPECT_STREQ(palette::of(palette::lane_style(LaneRole::oncoming)).name, "lane_oncoming");
  EXPECT_STREQ(palette::of(palette::course_style(LaneRole::unused)).name, "course_unused");
  EXPECT_STREQ(palette::of(Style::uncertainty).name, "uncertainty");
  EXPECT_STREQ(palette::of(Style::id).name, "id");
  EXPECT_STREQ(palette::of(Layer::boundaries).name, "boundaries");
  EXPECT_STREQ(palette::of(Layer::vehicle).name, "vehicle");
}

}  // namespace
}  // namespace laneloom::drawing
