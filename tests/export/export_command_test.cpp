#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commands.hpp"
#include "laneloom/polyline.hpp"
#include "simulation/lanelet2.hpp"
#include "simulation/opendrive.hpp"

namespace laneloom::exports {
namespace {

using testing::HasSubstr;
using testing::Not;

class ExportCommand : public Commands {
 protected:
  void simulate(const std::string& scenario) {
    ASSERT_TRUE(done("simulate --scenario " + scenario + " --frames drive.frames.jsonl --duration 20"));
  }
  bool export_drive(const std::string& output, bool plain) {
    return done("export drive.frames.jsonl " + output + (plain ? " --plain" : ""));
  }
};

TEST_F(ExportCommand, FramesRecordingsAndMapsGiveTheSameMap) {
  simulate("intersection");
  const auto exported = [&](const std::string& in) {
    EXPECT_TRUE(done("export --in " + in + " --lanelet2 map.osm"));
    return text("map.osm");
  };
  const std::string of_frames = exported("drive.frames.jsonl");
  EXPECT_THAT(output(), HasSubstr("made of the detections"));
  EXPECT_GT(simulation::load_lanelet2(file("map.osm")).lanes.size(), 8u);
  for (const std::string maps : {"maps.mcap", "maps.jsonl"}) {
    ASSERT_TRUE(done("replay --in drive.frames.jsonl --out " + maps));
    const std::string of_maps = exported(maps);
    EXPECT_THAT(output(), HasSubstr("maps read"));
    EXPECT_TRUE(maps != "maps.mcap" || of_maps == of_frames);
  }
}

/// How far points are from a line, where they are beside it and not before or behind it.
double farthest_m(const Polyline& points, const Polyline& from) {
  const MeasuredPolyline line(from);
  double most_m = 0.0;
  for (const Point& point : points)
    if (const auto foot = line.project(point); foot.inside) most_m = std::max(most_m, foot.distance_m);
  return most_m;
}

std::size_t successors_of(const simulation::Road& road) {
  std::size_t count = 0;
  for (const simulation::RoadLane& lane : road.lanes) count += lane.successors.size();
  return count;
}

TEST_F(ExportCommand, OpenDriveHasTheLanesAndMarksOfLanelet2) {
  for (const std::string scenario : {"town", "exit"}) {
    simulate(scenario);
    ASSERT_TRUE(done("export drive.frames.jsonl --lanelet2 map.osm --opendrive map.xodr"));
    LeftOut nothing(/*strict=*/true);
    const simulation::Road osm = simulation::load_lanelet2(file("map.osm"));
    const simulation::Road xodr = simulation::load_opendrive(file("map.xodr"), 10.0, nothing);
    ASSERT_GT(osm.lanes.size(), 5u);
    EXPECT_EQ(xodr.lanes.size(), osm.lanes.size());
    for (const simulation::RoadLane& lane : osm.lanes) {
      const Point middle = MeasuredPolyline(lane.centerline).at(0.5 * length(lane.centerline));
      const auto distance_m = [&](const simulation::RoadLane& other) {
        return (MeasuredPolyline(other.centerline).at(0.5 * length(other.centerline)) - middle).norm();
      };
      const simulation::RoadLane& same = *std::ranges::min_element(xodr.lanes, {}, distance_m);
      EXPECT_LT(farthest_m(same.left, lane.left), 0.1) << scenario << " lane " << lane.id;
      EXPECT_LT(farthest_m(same.right, lane.right), 0.2) << scenario << " lane " << lane.id;
    }
    // The lane of the exit bends at a joint. Its two roads of OpenDRIVE lie half a metre apart there, and the
    // reader does not link them.
    const std::size_t apart = scenario == "exit" ? 1 : 0;
    EXPECT_EQ(successors_of(xodr) + apart, successors_of(osm)) << scenario;
    for (const MarkingType type : {MarkingType::laneline, MarkingType::stopline}) {
      const auto is_one = [&](const simulation::RoadMarking& marking) { return marking.type == type; };
      EXPECT_EQ(std::ranges::any_of(xodr.markings, is_one), std::ranges::any_of(osm.markings, is_one));
    }
  }
}

TEST_F(ExportCommand, OsmiumFindsEveryReference) {
  simulate("intersection");
  ASSERT_TRUE(done("export --in drive.frames.jsonl --lanelet2 map.osm"));
  EXPECT_EQ(shell("osmium check-refs -r map.osm"), 0) << output();
  EXPECT_THAT(output(), HasSubstr("Ways      in relations missing: 0"));
}

TEST_F(ExportCommand, PlainLanelet2HasStopLinesAsWaysOnly) {
  simulate("intersection");
  for (const bool plain : {false, true}) {
    ASSERT_TRUE(export_drive("--lanelet2 map.osm", plain));
    EXPECT_EQ(text("map.osm").find("regulatory_element") == std::string::npos, plain);
    EXPECT_THAT(text("map.osm"), HasSubstr("stop_line"));
  }
}

TEST_F(ExportCommand, PlainOpenDriveHasNoStopLines) {
  simulate("intersection");
  for (const bool plain : {false, true}) {
    ASSERT_TRUE(export_drive("--opendrive map.xodr", plain));
    EXPECT_EQ(text("map.xodr").find("type=\"roadMark\"") == std::string::npos, plain);
  }
  EXPECT_EQ(run("export drive.frames.jsonl --geojson map.json --origin 48,11 --plain"), 64);
}

TEST_F(ExportCommand, MapsNeedNotTellHowOftenALineWasSeen) {
  simulate("straight");
  ASSERT_TRUE(done("replay drive.frames.jsonl --out maps.jsonl"));
  std::istringstream lines(text("maps.jsonl"));
  std::ofstream minimal(file("minimal.jsonl"));
  minimal << "{\"cut off\n";
  for (std::string line; std::getline(lines, line);) {
    nlohmann::json map = nlohmann::json::parse(line);
    for (nlohmann::json& instance : map["instances"]) instance.erase("observations");
    minimal << map << '\n';
  }
  minimal.close();
  ASSERT_TRUE(done("export minimal.jsonl --lanelet2 map.osm"));
  EXPECT_THAT(output(), HasSubstr("maps read"));
}

TEST_F(ExportCommand, MapsThatAreEarlierThanOneBeforeAreTold) {
  simulate("straight");
  ASSERT_TRUE(done("replay drive.frames.jsonl --out maps.jsonl"));
  std::ofstream(file("twice.jsonl")) << text("maps.jsonl") << text("maps.jsonl");
  ASSERT_TRUE(done("export twice.jsonl --lanelet2 map.osm"));
  EXPECT_THAT(output(), HasSubstr(" x a map is earlier than one before it"));
}

TEST_F(ExportCommand, GeoJsonNeedsAnOrigin) {
  simulate("straight");
  EXPECT_EQ(run("export --in drive.frames.jsonl --geojson map.json"), 64);
  EXPECT_THAT(output(), HasSubstr("--origin"));
  EXPECT_EQ(run("export --in drive.frames.jsonl --geojson map.json --origin 91,0"), 64);
  EXPECT_THAT(output(), HasSubstr("LAT,LON"));
  ASSERT_TRUE(done("export --in drive.frames.jsonl --geojson map.json --origin 48.137,11.575"));
  EXPECT_FALSE(json_of("map.json").at("features").empty());
}

/// Moves the poses of a file of frames.
void move_poses(const std::string& path, double by_m) {
  std::istringstream lines(content(path));
  std::ofstream out(path);
  for (std::string line; std::getline(lines, line);) {
    nlohmann::json frame = nlohmann::json::parse(line);
    for (std::size_t axis = 0; axis < 2; ++axis)
      frame["pose"][axis] = frame["pose"][axis].get<double>() + by_m;
    out << frame.dump() << '\n';
  }
}

TEST_F(ExportCommand, PosesFarFromTheOriginAreRefused) {
  simulate("straight");
  move_poses(file("drive.frames.jsonl"), 600'000.0);
  ASSERT_TRUE(done("export drive.frames.jsonl --opendrive map.xodr"));
  EXPECT_EQ(run("export drive.frames.jsonl --geojson map.json --origin 48.137,11.575"), 1);
  EXPECT_THAT(output(), HasSubstr("km from the origin of the map frame"));
  EXPECT_FALSE(exists("map.json"));
}

TEST_F(ExportCommand, WithoutAPlaceAMapOfPosesInUtmKeepsItsShape) {
  simulate("straight");
  move_poses(file("drive.frames.jsonl"), 4'000'000.0);
  ASSERT_TRUE(done("export drive.frames.jsonl --lanelet2 map.osm --no-extras")) << output();
  EXPECT_THAT(output(), HasSubstr("those of a map that begins at 0, 0"));
  ASSERT_TRUE(
      done("simulate --lanelet2 map.osm --frames again.frames.jsonl --truth again.json --duration 5"));
  const nlohmann::json road = json_of("again.json");
  ASSERT_FALSE(road.at("lanes").empty());
  for (const nlohmann::json& lane : road.at("lanes")) {
    const auto &left = lane.at("left").at(0), &right = lane.at("right").at(0);
    EXPECT_NEAR(std::hypot(left.at(0).get<double>() - right.at(0).get<double>(),
                           left.at(1).get<double>() - right.at(1).get<double>()),
                3.5, 0.2);
  }
}

TEST_F(ExportCommand, ShouldersAreNoLanesInAnyFormat) {
  simulate("motorway");
  std::ofstream(file("c.yaml")) << "mapper: {lane: {publish_side_strips: true}}\n";
  const std::string output = " --lanelet2 map.osm --opendrive map.xodr --geojson map.json --origin 48.1,11.5";
  ASSERT_TRUE(done("export drive.frames.jsonl" + output));
  const std::size_t lanes = simulation::load_lanelet2(file("map.osm")).lanes.size();
  EXPECT_THAT(text("map.osm"), Not(HasSubstr("road_shoulder")));
  ASSERT_TRUE(done("export drive.frames.jsonl --config c.yaml" + output));
  EXPECT_THAT(text("map.osm"), HasSubstr("road_shoulder"));
  EXPECT_THAT(text("map.xodr"), HasSubstr("type=\"shoulder\""));
  EXPECT_THAT(text("map.json"), HasSubstr("\"kind\":\"shoulder\""));
  EXPECT_EQ(simulation::load_lanelet2(file("map.osm")).lanes.size(), lanes);
  ASSERT_TRUE(done("export drive.frames.jsonl --config c.yaml --no-extras" + output));
  EXPECT_THAT(text("map.osm"), Not(HasSubstr("road_shoulder")));
  EXPECT_THAT(text("map.osm"), HasSubstr("emergency_lane"));
}

TEST_F(ExportCommand, CycleLanesAreNoLanesInAnyFormat) {
  const std::string road = "--opendrive " LANELOOM_ROADS "/cycle_lanes.xodr";
  ASSERT_TRUE(done("simulate " + road + " --frames drive.frames.jsonl --duration 20 --noise inhouse"));
  std::ofstream(file("c.yaml")) << "mapper: {lane: {publish_side_strips: true}}\n";
  const std::string output = " --lanelet2 map.osm --opendrive map.xodr --geojson map.json --origin 48.1,11.5";
  ASSERT_TRUE(done("export drive.frames.jsonl --config c.yaml" + output));
  EXPECT_THAT(text("map.osm"), HasSubstr("bicycle_lane"));
  EXPECT_THAT(text("map.osm"), HasSubstr("participant:bicycle"));
  EXPECT_THAT(text("map.xodr"), HasSubstr("type=\"biking\""));
  EXPECT_THAT(text("map.json"), HasSubstr("\"kind\":\"cycle\""));
  const simulation::Road again = simulation::load_lanelet2(file("map.osm"));
  EXPECT_FALSE(again.lanes.empty());
  for (const simulation::RoadLane& lane : again.lanes)
    EXPECT_GT((lane.left.front() - lane.right.front()).norm(), 2.5);
}

TEST_F(ExportCommand, SeveralDrivesAreOneMapInTheFrameOfTheFirst) {
  simulate("intersection");
  ASSERT_TRUE(done("export drive.frames.jsonl --lanelet2 one.osm"));
  for (const std::string seed : {"2", "3"}) {
    const std::string frames = seed + ".frames.jsonl";
    ASSERT_TRUE(
        done("simulate --scenario intersection --seed " + seed + " --frames " + frames + " --duration 20"));
    move_poses(file(frames), 1.0);
  }
  std::ofstream(file("broken.jsonl")) << "nothing\n";
  const std::string command =
      "export drive.frames.jsonl 2.frames.jsonl 3.frames.jsonl broken.jsonl --lanelet2 all.osm "
      "--report report.json";
  ASSERT_EQ(run(command), 2) << output();
  EXPECT_THAT(output(), HasSubstr("broken.jsonl"));
  EXPECT_THAT(output(), HasSubstr("left out"));
  const nlohmann::json report = json_of("report.json");
  ASSERT_EQ(report.at("drives").size(), 3u);
  EXPECT_EQ(report.at("left_out").at(0).at("file"), "broken.jsonl");
  for (const std::size_t drive : {1U, 2U}) {
    EXPECT_NEAR(report["drives"][drive].at("mean_m").get<double>(), 1.41, 0.3);
    EXPECT_GT(report["drives"][drive].at("met_share").get<double>(), 0.8);
  }
  const std::size_t of_one = simulation::load_lanelet2(file("one.osm")).lanes.size();
  EXPECT_LT(simulation::load_lanelet2(file("all.osm")).lanes.size(), of_one + of_one / 2)
      << "nothing is there twice";
  EXPECT_EQ(run(command + " --strict"), 1);
}

TEST_F(ExportCommand, ADriveInAnotherFrameIsTold) {
  simulate("straight");
  std::ofstream(file("utm.yaml")) << "dds: {map_frame_id: utm32}";
  ASSERT_TRUE(done("replay drive.frames.jsonl --out maps.mcap"));
  ASSERT_TRUE(done("replay drive.frames.jsonl --config utm.yaml --out utm.mcap"));
  ASSERT_TRUE(done("export maps.mcap utm.mcap --lanelet2 map.osm"));
  EXPECT_THAT(output(), HasSubstr("utm.mcap: is in the frame 'utm32', and the drives before in 'map'"));
}

TEST_F(ExportCommand, WrongUseAndInputAreNamed) {
  EXPECT_EQ(run("export --in x.mcap"), 64) << "nothing to write";
  EXPECT_EQ(run("export --in missing.mcap --lanelet2 map.osm"), 1);
  EXPECT_THAT(output(), HasSubstr("missing.mcap"));
  std::ofstream(file("broken.jsonl")) << "{\"instances\": 7}\n";
  EXPECT_EQ(run("export --in broken.jsonl --lanelet2 map.osm"), 1);
  EXPECT_THAT(output(), HasSubstr("broken.jsonl"));
  std::ofstream(file("empty.jsonl")) << "";
  EXPECT_EQ(run("export --in empty.jsonl --lanelet2 map.osm"), 1);
  EXPECT_THAT(output(), HasSubstr("empty.jsonl: is empty"));
  EXPECT_EQ(run("export --in empty.jsonl --lanelet2 empty.jsonl"), 1);
  EXPECT_THAT(output(), HasSubstr("written over"));
  EXPECT_FALSE(exists("map.osm"));
}

}  // namespace
}  // namespace laneloom::exports
