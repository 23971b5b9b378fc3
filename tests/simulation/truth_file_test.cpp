#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "simulation/road.hpp"
#include "simulation/scenarios.hpp"
#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::simulation {
namespace {

namespace fs = std::filesystem;

class TruthFile : public testing::Test {
 protected:
  std::string saved() {
    save_truth(path, make_scenario("curve"));
    std::ifstream in(path);
    std::ostringstream content;
    content << in.rdbuf();
    return content.str();
  }
  // The message for the saved file with `from` replaced by `to`.
  std::string error(const std::string& from, const std::string& to) {
    std::string content = saved();
    const std::size_t at = content.find(from);
    if (at == std::string::npos) return "not in the file";
    std::ofstream(path) << content.replace(at, from.size(), to);
    return thrown_by([&] { load_truth(path); });
  }

  const TemporaryFolder folder;
  const fs::path path = folder.file("truth.json");
};

TEST_F(TruthFile, IsReadAsItWasWritten) {
  const Road road = make_scenario("split");
  save_truth(path, road);
  const Road read = load_truth(path);
  EXPECT_EQ(read.name, road.name);
  EXPECT_EQ(read.right_hand_traffic, road.right_hand_traffic);
  ASSERT_EQ(read.markings.size(), road.markings.size());
  for (std::size_t i = 0; i < read.markings.size(); ++i) {
    EXPECT_EQ(read.markings[i].id, road.markings[i].id);
    EXPECT_EQ(read.markings[i].type, road.markings[i].type);
    EXPECT_EQ(read.markings[i].style, road.markings[i].style);
    EXPECT_EQ(read.markings[i].points, road.markings[i].points);
  }
  ASSERT_EQ(read.lanes.size(), road.lanes.size());
  for (std::size_t i = 0; i < read.lanes.size(); ++i) {
    EXPECT_EQ(read.lanes[i].left, road.lanes[i].left);
    EXPECT_EQ(read.lanes[i].right, road.lanes[i].right);
    EXPECT_EQ(read.lanes[i].centerline, road.lanes[i].centerline);
    EXPECT_EQ(read.lanes[i].left_marking, road.lanes[i].left_marking);
    EXPECT_EQ(read.lanes[i].right_marking, road.lanes[i].right_marking);
    EXPECT_EQ(read.lanes[i].in_intersection, road.lanes[i].in_intersection);
    EXPECT_EQ(read.lanes[i].successors, road.lanes[i].successors);
  }
  ASSERT_EQ(read.drive.poses().size(), road.drive.poses().size());
  EXPECT_EQ(read.drive.poses().back().stamp_ns, road.drive.poses().back().stamp_ns);
  EXPECT_EQ(read.drive.poses().back().position, road.drive.poses().back().position);
}

TEST_F(TruthFile, ErrorsNameFileAndKey) {
  EXPECT_NE(error("\"solid\"", "\"dotted\"").find("truth.json: markings[0].style: must be one of"),
            std::string::npos);
  EXPECT_NE(error("\"in_intersection\":false,", "").find("lanes[0].in_intersection: is missing"),
            std::string::npos);
  EXPECT_NE(error("\"driving_side\":\"right\"", "\"driving_side\":\"up\"").find("driving_side"),
            std::string::npos);
  EXPECT_NE(error("\"version\":1", "\"version\":2").find("version"), std::string::npos);
  EXPECT_NE(error("\"left_marking\":", "\"left_marking\":99").find("unknown id 99"), std::string::npos);
  EXPECT_NE(error("\"drive\":[[0.0,", "\"drive\":[[-1.0,").find("drive[0]"), std::string::npos);
  EXPECT_NE(error("{", "").find("truth.json: is not JSON: line 1, column "), std::string::npos);
}

TEST_F(TruthFile, WhatWouldTakeAllMemoryIsRefused) {
  Road road = make_scenario("curve");
  const auto complaint = [&] {
    save_truth(path, road);
    try {
      load_truth(path);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  road.markings[1].points = {{0, 0, 0}, {1e9, 0, 0}};
  EXPECT_NE(complaint().find("truth.json: markings[1].points[1]: is too far away"), std::string::npos);
  road.markings[1].points = {{0, 0, 0}, {300'001, 0, 0}};
  EXPECT_NE(complaint().find("truth.json: markings[1].points: is beyond 300 km"), std::string::npos);
  road.markings[1].points = {{0, 0, 0}, {290e3, 0, 0}};
  EXPECT_EQ(complaint(), "");
  road.lanes[0].centerline = {{0, 0, 0}, {300'001, 0, 0}};
  EXPECT_NE(complaint().find("truth.json: lanes[0].centerline: is beyond 300 km"), std::string::npos);
  road.lanes[0].left = {{0, 0, 0}, {200e3, 0, 0}};
  road.lanes[0].right = {{0, 0, 0}, {200e3, 0, 0}};
  EXPECT_NE(complaint().find("truth.json: lanes[0].right: is beyond 300 km"), std::string::npos);
}

TEST_F(TruthFile, AbsentFilesAreErrors) {
  EXPECT_THROW(load_truth(path.parent_path() / "absent.json"), std::runtime_error);
  EXPECT_THROW(save_truth(path.parent_path() / "absent" / "truth.json", {}), std::runtime_error);
}

}  // namespace
}  // namespace laneloom::simulation
