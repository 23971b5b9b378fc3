#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "drives.hpp"
#include "export/geojson_file.hpp"
#include "export/lanelet2_file.hpp"
#include "export/weave.hpp"
#include "export/weld.hpp"
#include "laneloom/polyline.hpp"
#include "simulation/lanelet2.hpp"
#include "temporary_folder.hpp"

namespace laneloom::exports {
namespace {

using testing::SizeIs;

const Origin kOrigin{.latitude_deg = 48.137, .longitude_deg = 11.575};

/// An intersection, seen without noise and written.
class ExportFiles : public testing::Test {
 protected:
  ExportFiles() {
    const test::MappedDrive drive = test::map_drive("intersection", "none");
    map_ = weave(test::surveyed(drive), drive.config);
    network_ = weld(map_);
  }
  std::string file(const std::string& name) const { return folder_.file(name); }

  LocalMap map_;
  RoadNetwork network_;

 private:
  TemporaryFolder folder_;
};

TEST_F(ExportFiles, OurReaderFindsInALanelet2FileWhatWasWritten) {
  write_lanelet2(file("map.osm"), network_, kOrigin);
  const simulation::Road road = simulation::load_lanelet2(file("map.osm"));
  ASSERT_THAT(road.lanes, SizeIs(network_.lanelets.size()));
  std::size_t followed = 0;
  for (std::size_t i = 0; i < road.lanes.size(); ++i) {
    const auto begin = network_.nodes[end_node(network_, network_.lanelets[i].left, false)];
    EXPECT_LT((road.lanes[i].left.front() - begin).norm(), 1e-3)
        << "to a tenth of a millimetre, and not turned";
    EXPECT_EQ(road.lanes[i].in_intersection,
              network_.lanelets[i].turn != Linkage::Turn::unknown ||
                  (road.lanes[i].left_marking == kNoElement && road.lanes[i].right_marking == kNoElement));
    followed += road.lanes[i].successors.size();
  }
  EXPECT_GT(followed, map_.linkages.size());
  EXPECT_TRUE(road.right_hand_traffic);
  const auto count = [&](MarkingType type) {
    return std::ranges::count(road.markings, type, &simulation::RoadMarking::type);
  };
  EXPECT_EQ(count(MarkingType::stopline), std::ssize(map_.stoplines));
  EXPECT_GT(count(MarkingType::laneline), 0);
  EXPECT_GT(count(MarkingType::roadedge), 0);
}

TEST_F(ExportFiles, Lanelet2HasWhatAutowareAsksFor) {
  write_lanelet2(file("map.osm"), network_, kOrigin);
  const std::string text = content(file("map.osm"));
  for (const char* part :
       {"<MetaInfo", "k=\"local_x\"", "k=\"local_y\"", "k=\"ele\"", "k=\"one_way\" v=\"yes\"",
        "k=\"turn_direction\" v=\"left\"", "k=\"turn_direction\" v=\"right\"",
        "k=\"turn_direction\" v=\"straight\"", "k=\"subtype\" v=\"road_marking\"",
        "role=\"regulatory_element\"", "role=\"refers\""})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST_F(ExportFiles, GeoJsonIsOnEarthLongitudeFirst) {
  write_geojson(file("map.json"), network_, kOrigin);
  std::ifstream in(file("map.json"));
  const auto json = nlohmann::json::parse(in);
  EXPECT_EQ(json.at("type"), "FeatureCollection");
  EXPECT_FALSE(json.contains("crs"));
  ASSERT_THAT(json.at("features"), SizeIs(network_.ways.size() + 2 * network_.lanelets.size()));
  for (const auto& feature : json.at("features")) {
    const auto& geometry = feature.at("geometry");
    const bool is_polygon = geometry.at("type") == "Polygon";
    const auto& positions = is_polygon ? geometry.at("coordinates").at(0) : geometry.at("coordinates");
    for (const auto& position : positions) {
      EXPECT_NEAR(position.at(0).get<double>(), kOrigin.longitude_deg, 0.01);
      EXPECT_NEAR(position.at(1).get<double>(), kOrigin.latitude_deg, 0.01);
    }
    EXPECT_TRUE(!is_polygon || positions.front() == positions.back());
  }
}

/// A graph can be made of the file alone: ids are unique, and all that are named are there.
TEST_F(ExportFiles, GeoJsonIsAGraph) {
  write_geojson(file("map.json"), network_, kOrigin);
  std::ifstream in(file("map.json"));
  std::map<std::string, nlohmann::json> features;
  const auto json = nlohmann::json::parse(in);
  for (const auto& feature : json.at("features"))
    EXPECT_TRUE(features.emplace(feature.at("id"), feature).second) << feature.at("id");
  std::ptrdiff_t successions = 0;
  std::set<ElementId> lanes;  // of one lane there can be several lanelets
  for (const auto& [id, feature] : features) {
    if (!id.starts_with("lanelet/")) continue;
    const auto& properties = feature.at("properties");
    if (!properties.at("lane").is_null()) lanes.insert(properties.at("lane").get<ElementId>());
    for (const char* key : {"left", "right", "centreline"})
      ASSERT_TRUE(features.contains(properties.at(key)));
    const auto centre = features.at(properties.at("centreline")).at("geometry").at("coordinates");
    for (const std::string next : properties.at("successors")) {
      ++successions;
      ASSERT_TRUE(features.contains(next));
      const auto on =
          features.at(features.at(next).at("properties").at("centreline")).at("geometry").at("coordinates");
      EXPECT_EQ(centre.back(), on.front()) << id << " leads to " << next;
    }
  }
  EXPECT_EQ(lanes.size(), map_.lanes.size());
  EXPECT_GE(successions, std::ssize(map_.linkages));
}

TEST_F(ExportFiles, WithoutExtrasThereAreNoTagsOfOthers) {
  write_lanelet2(file("map.osm"), network_, kOrigin, false);
  const std::string text = content(file("map.osm"));
  for (const char* tag : {"local_x", "local_y", "turn_direction", "laneloom:"})
    EXPECT_EQ(text.find(tag), std::string::npos) << tag;
  for (const char* tag : {"k=\"ele\"", "k=\"type\" v=\"lanelet\"", "k=\"subtype\" v=\"road\""})
    EXPECT_NE(text.find(tag), std::string::npos) << tag;
}

TEST_F(ExportFiles, FilesThatCannotBeWrittenAreNamed) {
  EXPECT_THROW(write_lanelet2(file("nowhere/map.osm"), network_, kOrigin), std::runtime_error);
  EXPECT_THROW(write_geojson(file("nowhere/map.json"), network_, kOrigin), std::runtime_error);
}

}  // namespace
}  // namespace laneloom::exports
