#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "laneloom/polyline.hpp"
#include "simulation/lanelet2.hpp"
#include "simulation/opendrive.hpp"
#include "support/child_process.hpp"
#include "temporary_folder.hpp"

namespace laneloom::exports {
namespace {

using testing::HasSubstr;

/// Runs the real `laneloom`.
class ExportCommand : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }
  int run(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{LANELOOM_COMMAND};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return support::ChildProcess(command, file("output")).wait();
  }
  std::string output() const { return content(file("output")); }
  void simulate(const std::string& scenario) {
    ASSERT_EQ(
        run({"simulate", "--scenario", scenario, "--frames", file("drive.frames.jsonl"), "--duration", "20"}),
        0)
        << output();
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(ExportCommand, FramesRecordingsAndMapsGiveTheSameMap) {
  simulate("intersection");
  const auto exported = [&](const std::string& in) {
    EXPECT_EQ(run({"export", "--in", file(in), "--lanelet2", file("map.osm")}), 0) << output();
    return content(file("map.osm"));
  };
  const std::string of_frames = exported("drive.frames.jsonl");
  EXPECT_THAT(output(), HasSubstr("made of the detections"));
  EXPECT_GT(simulation::load_lanelet2(file("map.osm")).lanes.size(), 8u);
  for (const std::string maps : {"maps.mcap", "maps.jsonl"}) {
    ASSERT_EQ(run({"replay", "--in", file("drive.frames.jsonl"), "--out", file(maps)}), 0) << output();
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
    ASSERT_EQ(run({"export", file("drive.frames.jsonl"), "--lanelet2", file("map.osm"), "--opendrive",
                   file("map.xodr")}),
              0)
        << output();
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
    EXPECT_EQ(successors_of(xodr), successors_of(osm)) << scenario;
    for (const MarkingType type : {MarkingType::laneline, MarkingType::stopline}) {
      const auto is_one = [&](const simulation::RoadMarking& marking) { return marking.type == type; };
      EXPECT_EQ(std::ranges::any_of(xodr.markings, is_one), std::ranges::any_of(osm.markings, is_one));
    }
  }
}

TEST_F(ExportCommand, OsmiumFindsEveryReference) {
  simulate("intersection");
  ASSERT_EQ(run({"export", "--in", file("drive.frames.jsonl"), "--lanelet2", file("map.osm")}), 0)
      << output();
  EXPECT_EQ(
      support::ChildProcess({"/usr/bin/osmium", "check-refs", "-r", file("map.osm")}, file("output")).wait(),
      0)
      << output();
  EXPECT_THAT(output(), HasSubstr("Ways      in relations missing: 0"));
}

TEST_F(ExportCommand, PlainLanelet2HasStopLinesAsWaysOnly) {
  simulate("intersection");
  for (const bool plain : {false, true}) {
    std::vector<std::string> arguments{"export", "--in", file("drive.frames.jsonl"), "--lanelet2",
                                       file("map.osm")};
    if (plain) arguments.emplace_back("--plain");
    ASSERT_EQ(run(arguments), 0) << output();
    EXPECT_EQ(content(file("map.osm")).find("regulatory_element") == std::string::npos, plain);
    EXPECT_THAT(content(file("map.osm")), HasSubstr("stop_line"));
  }
}

TEST_F(ExportCommand, GeoJsonNeedsAnOrigin) {
  simulate("straight");
  EXPECT_EQ(run({"export", "--in", file("drive.frames.jsonl"), "--geojson", file("map.json")}), 64);
  EXPECT_THAT(output(), HasSubstr("--origin"));
  EXPECT_EQ(
      run({"export", "--in", file("drive.frames.jsonl"), "--geojson", file("map.json"), "--origin", "91,0"}),
      64);
  EXPECT_THAT(output(), HasSubstr("LAT,LON"));
  ASSERT_EQ(run({"export", "--in", file("drive.frames.jsonl"), "--geojson", file("map.json"), "--origin",
                 "48.137,11.575"}),
            0)
      << output();
  std::ifstream in(file("map.json"));
  EXPECT_FALSE(nlohmann::json::parse(in).at("features").empty());
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

TEST_F(ExportCommand, SeveralDrivesAreOneMapInTheFrameOfTheFirst) {
  simulate("intersection");
  std::vector<std::string> command{"export", file("drive.frames.jsonl")};
  ASSERT_EQ(run({"export", file("drive.frames.jsonl"), "--lanelet2", file("one.osm")}), 0) << output();
  for (const std::string seed : {"2", "3"}) {
    const std::string frames = file(seed + ".frames.jsonl");
    ASSERT_EQ(run({"simulate", "--scenario", "intersection", "--seed", seed, "--frames", frames, "--duration",
                   "20"}),
              0);
    move_poses(frames, 1.0);
    command.push_back(frames);
  }
  std::ofstream(file("broken.jsonl")) << "nothing\n";
  command.insert(command.end(),
                 {file("broken.jsonl"), "--lanelet2", file("all.osm"), "--report", file("report.json")});
  ASSERT_EQ(run(command), 0) << output();
  EXPECT_THAT(output(), HasSubstr("broken.jsonl"));
  EXPECT_THAT(output(), HasSubstr("left out"));
  const nlohmann::json report = nlohmann::json::parse(content(file("report.json")));
  ASSERT_EQ(report.at("drives").size(), 3u);
  for (const std::size_t drive : {1U, 2U}) {
    EXPECT_NEAR(report["drives"][drive].at("mean_m").get<double>(), 1.41, 0.3);
    EXPECT_GT(report["drives"][drive].at("met_share").get<double>(), 0.8);
  }
  const std::size_t of_one = simulation::load_lanelet2(file("one.osm")).lanes.size();
  EXPECT_LT(simulation::load_lanelet2(file("all.osm")).lanes.size(), of_one + of_one / 2)
      << "nothing is there twice";
  command.emplace_back("--strict");
  EXPECT_EQ(run(command), 1);
}

TEST_F(ExportCommand, WrongUseAndInputAreNamed) {
  EXPECT_EQ(run({"export", "--in", file("x.mcap")}), 64) << "nothing to write";
  EXPECT_EQ(run({"export", "--in", file("missing.mcap"), "--lanelet2", file("map.osm")}), 1);
  EXPECT_THAT(output(), HasSubstr("missing.mcap"));
  std::ofstream(file("broken.jsonl")) << "{\"instances\": 7}\n";
  EXPECT_EQ(run({"export", "--in", file("broken.jsonl"), "--lanelet2", file("map.osm")}), 1);
  EXPECT_THAT(output(), HasSubstr("broken.jsonl"));
  std::ofstream(file("empty.jsonl")) << "";
  EXPECT_EQ(run({"export", "--in", file("empty.jsonl"), "--lanelet2", file("map.osm")}), 1);
  EXPECT_THAT(output(), HasSubstr("empty.jsonl: is empty"));
  EXPECT_EQ(run({"export", "--in", file("empty.jsonl"), "--lanelet2", file("empty.jsonl")}), 1);
  EXPECT_THAT(output(), HasSubstr("written over"));
  EXPECT_FALSE(std::filesystem::exists(file("map.osm")));
}

}  // namespace
}  // namespace laneloom::exports
