#include "simulation/argoverse2.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <optional>

#include "io/feather_writer.hpp"
#include "laneloom/polyline.hpp"
#include "road_checks.hpp"
#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::simulation {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> logs_in(const fs::path& directory) {
  LeftOut nothing(/*strict=*/true);
  return argoverse2_logs(directory, nothing);
}

class RealLogs : public testing::Test {
 protected:
  void SetUp() override {
    const fs::path data = fs::path(LANELOOM_DATA) / "argoverse2";
    if (!fs::is_directory(data)) GTEST_SKIP() << "no Argoverse 2 logs in " << data;
    for (const auto& entry : fs::directory_iterator(data)) logs.push_back(entry.path());
    std::sort(logs.begin(), logs.end());
    ASSERT_FALSE(logs.empty());
  }
  std::vector<fs::path> logs;
};

TEST_F(RealLogs, LanesAndMarkingsFitTogether) {
  for (const fs::path& log : logs) {
    const Road road = load_argoverse2(log);
    SCOPED_TRACE(road.name);
    EXPECT_GT(road.lanes.size(), 100u);
    EXPECT_LT(road.lanes.size(), 200u);
    EXPECT_GT(std::count_if(road.lanes.begin(), road.lanes.end(),
                            [](const RoadLane& l) { return l.in_intersection; }),
              40);
    for (const RoadLane& lane : road.lanes) {
      expect_left_is_left(lane);
      expect_successors_meet(road, lane, 0.1);
    }
    expect_borders_on_markings(road, 0.5);
    EXPECT_EQ(std::count_if(road.markings.begin(), road.markings.end(),
                            [](const RoadMarking& m) { return m.type == MarkingType::stopline; }),
              0);
  }
}

TEST_F(RealLogs, NoLineIsThereTwice) {
  for (const fs::path& log : logs) {
    const Road road = load_argoverse2(log);
    SCOPED_TRACE(road.name);
    for (const RoadMarking& a : road.markings) {
      if (a.type != MarkingType::laneline) continue;
      const MeasuredPolyline line(a.points);
      const Point middle = line.at(0.5 * line.length());
      for (const RoadMarking& b : road.markings) {
        if (&a == &b || b.type != MarkingType::laneline) continue;
        EXPECT_GT(MeasuredPolyline(b.points).project(middle).distance_m, 0.02) << a.id << " and " << b.id;
      }
    }
  }
}

TEST_F(RealLogs, TheVehicleDrivesInsideTheEdgesWithoutJumps) {
  for (const fs::path& log : logs) {
    const Road road = load_argoverse2(log);
    SCOPED_TRACE(road.name);
    EXPECT_NEAR(road.drive.duration_s(), 15.95, 0.05);
    const auto& poses = road.drive.poses();
    for (std::size_t i = 1; i < poses.size(); ++i) {
      EXPECT_EQ(poses[i].stamp_ns - poses[i - 1].stamp_ns, 10'000'000);
      EXPECT_LT((poses[i].position - poses[i - 1].position).norm(), 0.2);
    }
    for (const RoadMarking& marking : road.markings) {
      if (marking.type != MarkingType::roadedge) continue;
      const MeasuredPolyline edge(marking.points);
      for (std::size_t i = 0; i < poses.size(); i += 100)
        EXPECT_GT(edge.project(poses[i].position).distance_m, 1.0);
    }
  }
}

TEST_F(RealLogs, AsDistributedTheyGiveTheSameRoadAsWithACsv) {
  for (const fs::path& log : logs) {
    const TemporaryFolder folder;
    const fs::path given = fs::path(folder.path()) / "sensor" / "val" / log.filename();
    const fs::path converted = fs::path(folder.path()) / "csv" / log.filename();
    fs::create_directories(given / "map");
    fs::create_directories(converted);
    for (const auto& file : fs::directory_iterator(log)) {
      const fs::path name = file.path().filename();
      const bool is_map = name.extension() == ".json";
      if (name.extension() != ".csv") fs::create_symlink(file, is_map ? given / "map" / name : given / name);
      if (name.extension() != ".feather") fs::create_symlink(file, converted / name);
    }
    EXPECT_EQ(logs_in(folder.file("sensor")), std::vector{given});
    save_truth(folder.file("given.json"), load_argoverse2(given));
    save_truth(folder.file("converted.json"), load_argoverse2(converted));
    EXPECT_EQ(bytes_of(folder.file("given.json")), bytes_of(folder.file("converted.json")));
    EXPECT_GT(bytes_of(folder.file("given.json")).size(), 100'000u);
  }
}

// A made-up log of two opposite lanes, whose common border each draws its own way.
class MadeUpLog : public testing::Test {
 protected:
  void SetUp() override {
    write("city_SE3_egovehicle.csv",
          "timestamp_ns,qw,qx,qy,qz,tx_m,ty_m,tz_m\n1000000000,1,0,0,0,0,0,0\n1000000001,1,0,0,0,0,0,0\n"
          "2000000001,1,0,0,0,10,0,0\n");
    write("log_map_archive_x.json", map("SOLID_DASHED_YELLOW"));
  }

  void write(const std::string& name, const std::string& content) {
    std::ofstream(directory / name) << content;
  }

  static std::string map(const std::string& mark) {
    const auto lane = [&](int id, double y, const char* type, int successor) {
      const auto border = [&](double at, bool reverse) {
        const std::string a = R"({"x":0,"y":)" + std::to_string(at) + R"(,"z":0})";
        const std::string b = R"({"x":20,"y":)" + std::to_string(at) + R"(,"z":0})";
        return reverse ? "[" + b + "," + a + "]" : "[" + a + "," + b + "]";
      };
      const bool back = y > 0.0;
      return "\"" + std::to_string(id) + R"(":{"id":)" + std::to_string(id) +
             R"(,"is_intersection":false,"lane_type":")" + type + R"(","successors":[)" +
             std::to_string(successor) + R"(],"left_lane_boundary":)" + border(0.0, back) +
             R"(,"left_lane_mark_type":")" + mark + R"(","right_lane_boundary":)" + border(2.0 * y, back) +
             R"(,"right_lane_mark_type":"NONE"})";
    };
    return R"({"lane_segments":{)" + lane(10, -1.75, "VEHICLE", 99) + "," + lane(20, 1.75, "BIKE", 10) +
           R"(},"drivable_areas":{"1":{"area_boundary":[{"x":-5,"y":-3.6,"z":0},{"x":25,"y":-3.6,"z":0},)"
           R"({"x":25,"y":3.6,"z":0},{"x":-5,"y":3.6,"z":0}]}}})";
  }

  std::string error() {
    return thrown_by<std::exception>([&] { load_argoverse2(directory); });
  }

  const std::string kColumns = "timestamp_ns,qw,qx,qy,qz,tx_m,ty_m,tz_m\n";
  const TemporaryFolder folder;
  const fs::path directory = folder.path();
};

TEST_F(MadeUpLog, SharedBordersComeOnceAndBicycleLanesAreNoLanes) {
  const Road road = load_argoverse2(directory);
  ASSERT_EQ(road.lanes.size(), 1u);
  EXPECT_TRUE(road.lanes[0].successors.empty()) << "leads out of the archive";
  ASSERT_EQ(road.markings.size(), 2u);
  EXPECT_EQ(road.markings[0].type, MarkingType::laneline);
  EXPECT_EQ(road.markings[0].style, MarkingStyle::dashed) << "the nearer one of the double line";
  EXPECT_EQ(road.lanes[0].left_marking, road.markings[0].id);
  EXPECT_EQ(road.lanes[0].right_marking, road.markings[1].id) << "unpainted, along the edge";
  EXPECT_EQ(road.markings[1].points.front(), road.markings[1].points.back()) << "a ring";
  EXPECT_NEAR(road.drive.pose_at(0.5).position.x(), 5.0, 1e-6);
}

TEST_F(MadeUpLog, IsReadAsItIsDistributed) {
  fs::create_directory(directory / "map");
  fs::rename(directory / "log_map_archive_x.json", directory / "map" / "log_map_archive_x.json");
  fs::remove(directory / "city_SE3_egovehicle.csv");
  EXPECT_NE(error().find("has no city_SE3_egovehicle.feather"), std::string::npos) << error();
  write_bytes(directory / "city_SE3_egovehicle.feather",
              FeatherWriter(pose_columns(7'000'000'000, 11)).write());
  const Road road = load_argoverse2(directory);
  EXPECT_EQ(road.markings.size(), 2u);
  EXPECT_NEAR(road.drive.duration_s(), 1.0, 1e-9);
  EXPECT_NEAR(road.drive.pose_at(0.55).position.x(), 5.5, 1e-6);
}

TEST_F(MadeUpLog, ImpossiblePosesOfAFeatherFileAreNamedWithTheirRow) {
  FeatherWriter::Columns columns = pose_columns(0, 5);
  std::get<std::vector<double>>(columns[1].second)[3] = 2.0;
  write_bytes(directory / "city_SE3_egovehicle.feather", FeatherWriter(columns).write());
  EXPECT_NE(error().find("feather: row 3: a quaternion of unit length"), std::string::npos) << error();
  columns = pose_columns(0, 5);
  std::get<std::vector<double>>(columns[6].second)[1] = std::numeric_limits<double>::infinity();
  write_bytes(directory / "city_SE3_egovehicle.feather", FeatherWriter(columns).write());
  EXPECT_NE(error().find("feather: row 1: a finite number"), std::string::npos) << error();
}

TEST_F(MadeUpLog, LogsAreFoundBelowADirectory) {
  EXPECT_EQ(logs_in(directory), std::vector{directory}) << "it is one itself";
  const TemporaryFolder data_set;
  const fs::path val = fs::path(data_set.path()) / "sensor" / "val";
  for (const char* const log : {"b", "a", "no_poses"}) fs::create_directories(val / log / "map");
  for (const char* const log : {"a", "b"}) std::ofstream(val / log / "city_SE3_egovehicle.feather");
  EXPECT_EQ(logs_in(data_set.path()), (std::vector{val / "a", val / "b"}));
  EXPECT_THROW(logs_in(val / "no_poses"), std::runtime_error);
}

TEST_F(MadeUpLog, BadFilesAreNamedWithKeyOrLine) {
  std::string broken = map("NONE");
  broken.replace(broken.find("\"z\":0"), 5, "\"z\":[]");
  write("log_map_archive_x.json", broken);
  EXPECT_NE(error().find("lane_segments.10.left_lane_boundary[0].z: must be a number"), std::string::npos)
      << error();
  std::string point = map("NONE");
  point.replace(point.find("\"x\":20"), 6, "\"x\":0");
  write("log_map_archive_x.json", point);
  EXPECT_NE(error().find("lane_segments.10.left_lane_boundary: has no length"), std::string::npos) << error();
  write("log_map_archive_x.json", map("NONE"));
  write("city_SE3_egovehicle.csv", kColumns + "1,1,0,0,0,0,0,0\n2,1,0,0,zero,0,0,0\n");
  EXPECT_NE(error().find("city_SE3_egovehicle.csv:3"), std::string::npos) << error();
  fs::remove(directory / "log_map_archive_x.json");
  EXPECT_NE(error().find("log_map_archive"), std::string::npos) << error();
}

TEST_F(MadeUpLog, ALogOfWhichNoLaneIsLeftIsAnError) {
  std::string text_ids = map("NONE");
  for (const std::string id : {"10", "20"})
    text_ids.replace(text_ids.find("\"id\":" + id), 7, "\"id\":\"x\"");
  write("log_map_archive_x.json", text_ids);
  LeftOut left_out;
  const std::string complaint = thrown_by([&] { load_argoverse2(directory, left_out); });
  EXPECT_TRUE(complaint.ends_with("log_map_archive_x.json: has no lanes for vehicles")) << complaint;
  EXPECT_EQ(left_out.summary(),
            "2 x lane_segments: id: must be an integer that is not negative (first: lane_segments.10)");
}

TEST_F(MadeUpLog, ALaneWithoutSuccessorsLosesItsLinksAlone) {
  for (const std::string instead : {"", R"("successors":null,)"}) {
    std::string archive = map("NONE");
    const std::string key = R"("successors":[99],)";
    archive.replace(archive.find(key), key.size(), instead);
    write("log_map_archive_x.json", archive);
    LeftOut left_out;
    EXPECT_EQ(load_argoverse2(directory, left_out).lanes.size(), 1u);
    EXPECT_EQ(left_out.summary(), "1 x successors: is missing (first: lane_segments.10)");
    EXPECT_NE(error().find("lane_segments.10.successors: is missing"), std::string::npos) << error();
  }
}

TEST_F(MadeUpLog, ALaneThatIsGivenTwiceIsTakenOnce) {
  std::string archive = map("SOLID_WHITE");
  archive.replace(archive.find(R"("id":20)"), 7, R"("id":10)");
  archive.replace(archive.find("BIKE"), 4, "BUS");
  write("log_map_archive_x.json", archive);
  LeftOut left_out;
  EXPECT_EQ(load_argoverse2(directory, left_out).lanes.size(), 1u);
  EXPECT_EQ(left_out.summary(), "1 x lane_segments: id: is given twice (first: lane_segments.20)");
}

TEST_F(MadeUpLog, WhatWouldTakeAllMemoryIsRefused) {
  std::string far = map("NONE");
  far.replace(far.find("\"x\":20"), 6, "\"x\":1e300");
  write("log_map_archive_x.json", far);
  EXPECT_NE(error().find("lane_segments.10.left_lane_boundary[1].x: is too far away"), std::string::npos)
      << error();
  std::string long_lane = map("NONE");
  long_lane.replace(long_lane.find("\"x\":20"), 6, "\"x\":300001");
  write("log_map_archive_x.json", long_lane);
  EXPECT_NE(error().find("lane_segments.10.left_lane_boundary: is beyond 300 km"), std::string::npos)
      << error();
  std::string wide_area = map("NONE");
  wide_area.replace(wide_area.find("\"x\":25"), 6, "\"x\":300001");
  write("log_map_archive_x.json", wide_area);
  EXPECT_NE(error().find("drivable_areas.1.area_boundary: is beyond 300 km"), std::string::npos) << error();
  write("log_map_archive_x.json", map("NONE"));
  write("city_SE3_egovehicle.csv", kColumns + "0,1,0,0,0,0,0,0\n3600000000001,1,0,0,0,0,0,0\n");
  EXPECT_NE(error().find("city_SE3_egovehicle.csv: lasts longer than an hour"), std::string::npos) << error();
}

}  // namespace
}  // namespace laneloom::simulation
