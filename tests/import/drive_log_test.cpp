#include "import/drive_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <utility>
#include <vector>

#include "io/axes.hpp"
#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::imports {
namespace {

using testing::HasSubstr;

class DriveLogs : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& content) {
    std::ofstream(folder_.file(name)) << content;
  }
  std::string file(const std::string& name) const { return folder_.file(name); }
  template <typename Load>
  static std::string error(const Load& load) {
    return thrown_by([&] { load(); });
  }

  LeftOut strict_{true};

 private:
  TemporaryFolder folder_;
};

constexpr const char* kPoses =
    "timestamp_ns,qw,qx,qy,qz,tx_m,ty_m,tz_m\n2000,1,0,0,0,5,6,7\n1000002000,1,0,0,0,15,6,7\n";

TEST_F(DriveLogs, Argoverse2NamesSamplesByLogAndStamp) {
  std::filesystem::create_directories(file("log-a"));
  write("log-a/city_SE3_egovehicle.csv", kPoses);
  for (const std::string directory : {"log-a", "log-a/"}) {
    const DriveLog drive = argoverse2_drive(file(directory), strict_);
    EXPECT_EQ(drive.name, "log-a");
    ASSERT_EQ(drive.poses.size(), 2u);
    EXPECT_EQ(drive.poses[0].stamp_ns, 2000) << "the stamps of the log, not times since its start";
    EXPECT_EQ(drive.stamp_ns_of("log-a_315971916927482490"), 315971916927482490);
    EXPECT_EQ(drive.stamp_ns_of("log-b_315971916927482490"), std::nullopt);
    EXPECT_THAT(error([&] { drive.stamp_ns_of("log-a_1x"); }), HasSubstr("log-a_1x"));
    EXPECT_EQ(drive.stamp_ns_of("2000"), 2000) << "a stamp alone is of the log whose poses are around it";
    EXPECT_EQ(drive.stamp_ns_of("1999"), std::nullopt);
    EXPECT_EQ(drive.stamp_ns_of("1000002001"), std::nullopt);
    EXPECT_EQ(drive.T_body_points * Point(1, 2, 3), Point(1, 2, 3));
  }
}

TEST_F(DriveLogs, PlainTablesGiveStampsAndAxes) {
  write("poses.csv", kPoses);
  write("samples.csv", "token,timestamp_ns\na,17\nb,18\r\n");
  const DriveLog drive =
      plain_drive(file("poses.csv"), file("samples.csv"), io::axes_named("right-forward"), strict_);
  EXPECT_EQ(drive.stamp_ns_of("b"), 18);
  EXPECT_EQ(drive.stamp_ns_of("c"), std::nullopt);
  EXPECT_TRUE((drive.T_body_points * Point(2, 10, 1)).isApprox(Point(10, -2, 1)));

  const auto load = [&] {
    plain_drive(file("poses.csv"), file("samples.csv"), Eigen::Matrix3d::Identity(), strict_);
  };
  write("samples.csv", "token,timestamp_ns\na,17\na,18\n");
  EXPECT_THAT(error(load), HasSubstr("samples.csv:3: a sample that is given twice"));
  write("samples.csv", "token,timestamp_ns\na\n");
  EXPECT_THAT(error(load), HasSubstr("samples.csv:2: a whole number is expected"));
  write("samples.csv", "token,timestamp_ns\na,17.0\n");
  EXPECT_THAT(error(load), HasSubstr("samples.csv:2: a whole number is expected"));
}

TEST_F(DriveLogs, TablesOfSpreadsheetsMayBeginWithAMarkAndEndWithAnEmptyLine) {
  write("poses.csv", "\xef\xbb\xbf" + std::string(kPoses) + "\r\n");
  write("samples.csv", "\xef\xbb\xbftoken,timestamp_ns\r\na,17\r\n\r\n");
  const DriveLog drive =
      plain_drive(file("poses.csv"), file("samples.csv"), Eigen::Matrix3d::Identity(), strict_);
  EXPECT_EQ(drive.poses.size(), 2u);
  EXPECT_EQ(drive.stamp_ns_of("a"), 17);
}

TEST_F(DriveLogs, RowsThatAreWrongAreLeftOut) {
  write("poses.csv", std::string(kPoses) + "1500000000,1,0,0,0,nan,6,7\n2000000000,1,0\n");
  write("samples.csv", "token,timestamp_ns\na,17\na,17\nb,18\nc,1");
  LeftOut left_out;
  const DriveLog drive =
      plain_drive(file("poses.csv"), file("samples.csv"), Eigen::Matrix3d::Identity(), left_out);
  EXPECT_EQ(drive.poses.size(), 2u);
  EXPECT_EQ(drive.stamp_ns_of("b"), 18);
  EXPECT_EQ(left_out.summary(),
            "1 x a sample that is given twice (first: samples.csv:3), "
            "1 x a finite number is expected (first: poses.csv:4), "
            "1 x a number is expected (first: poses.csv:5)");
}

TEST_F(DriveLogs, TablesOfOtherColumnsAreRefused) {
  const auto load = [&] {
    plain_drive(file("poses.csv"), file("samples.csv"), Eigen::Matrix3d::Identity(), strict_);
  };
  const std::string rows = "2000,1,0,0,0,5,6,7\n1000002000,1,0,0,0,15,6,7\n";
  write("samples.csv", "token,timestamp_ns\na,17\n");
  write("poses.csv", "timestamp_ns,tx_m,ty_m,tz_m,qx,qy,qz,qw\n" + rows);  // as ROS orders them
  EXPECT_THAT(error(load), HasSubstr("poses.csv:1: the columns must be timestamp_ns,qw,qx,qy,qz,tx_m"));
  write("poses.csv", rows);
  EXPECT_THAT(error(load), HasSubstr("poses.csv:1: the columns must be"));
  write("poses.csv", "timestamp_ns,qw,qx,qy,qz,tx_m,ty_m,tz_m,speed\r\n" + rows);
  EXPECT_EQ(error(load), "");
  write("samples.csv", "timestamp_ns,token\na,17\n");
  EXPECT_THAT(error(load), HasSubstr("samples.csv:1: the columns must be token,timestamp_ns"));
  write("samples.csv", "");
  EXPECT_THAT(error(load), HasSubstr("samples.csv: is empty"));
  write("samples.csv", "\x89MCAP0\r\n");
  EXPECT_THAT(error(load),
              HasSubstr("samples.csv: is a recording (MCAP); a table of comma-separated values"));
  write("samples.csv", "token,timestamp_ns\na,17\n");
  write("poses.csv", "PAR1");
  EXPECT_THAT(error(load), HasSubstr("poses.csv: is a Parquet file; a table"));
}

/// Two scenes, each of one sample with LiDAR and camera; a LiDAR sweep between samples as well.
class NuScenes : public DriveLogs {
 protected:
  void SetUp() override {
    write("scene.json", R"([{"token":"s1","name":"scene-0001"},{"token":"s2","name":"scene-0002"}])");
    write("sample.json", R"([{"token":"k1","scene_token":"s1"},{"token":"k2","scene_token":"s2"}])");
    write("sensor.json",
          R"([{"token":"lidar","channel":"LIDAR_TOP"},{"token":"cam","channel":"CAM_FRONT"}])");
    // The LiDAR is turned by -90 degrees and pitched a little, which is to be of no account.
    write("calibrated_sensor.json",
          R"([{"token":"cs_lidar","sensor_token":"lidar","translation":[0.94,0.0,1.84],)"
          R"("rotation":[0.7070,0.0100,-0.0100,-0.7070]},)"
          R"({"token":"cs_cam","sensor_token":"cam","translation":[1.7,0,1.5],"rotation":[1,0,0,0]}])");
    write("sample_data.json", "[" + data("k1", "cs_lidar", "p1", 1'500'000, true) + "," +
                                  data("k1", "cs_cam", "p2", 1'510'000, true) + "," +
                                  data("k1", "cs_lidar", "p3", 1'550'000, false) + "," +
                                  data("k2", "cs_lidar", "p4", 9'000'000, true) + "]");
    write("ego_pose.json", "[" + pose("p4", 9'000'000, 400) + "," + pose("p3", 1'550'000, 103) + "," +
                               pose("p1", 1'500'000, 101) + "," + pose("p2", 1'510'000, 102) + "]");
  }
  static std::string data(const std::string& sample, const std::string& sensor, const std::string& pose,
                          int stamp_us, bool key) {
    return R"({"token":"d","sample_token":")" + sample + R"(","calibrated_sensor_token":")" + sensor +
           R"(","ego_pose_token":")" + pose + R"(","timestamp":)" + std::to_string(stamp_us) +
           R"(,"is_key_frame":)" + (key ? "true" : "false") + "}";
  }
  static std::string pose(const std::string& token, int stamp_us, int x_m) {
    return R"({"token":")" + token + R"(","timestamp":)" + std::to_string(stamp_us) +
           R"(,"rotation":[0,0,0,1],"translation":[)" + std::to_string(x_m) + ",7,0]}";
  }
  std::string scene_error() {
    return error([&] { nuscenes_drive(file(""), "scene-0001", strict_); });
  }
};

TEST_F(NuScenes, PosesOfAllSensorsOfTheSceneAndTheStampOfTheLidar) {
  const DriveLog drive = nuscenes_drive(file(""), "scene-0001", strict_);
  ASSERT_EQ(drive.poses.size(), 3u);
  EXPECT_EQ(drive.poses[0].stamp_ns, 1'500'000'000);
  EXPECT_EQ(drive.poses[2].stamp_ns, 1'550'000'000);
  EXPECT_EQ(drive.poses[2].position, Point(103, 7, 0));
  EXPECT_TRUE((transform(drive.poses[0]) * Point(1, 0, 0)).isApprox(Point(100, 7, 0))) << "turned by 180";
  EXPECT_EQ(drive.stamp_ns_of("k1"), 1'500'000'000) << "of the key frame, not of the sweep after it";
  EXPECT_EQ(drive.stamp_ns_of("k2"), std::nullopt);
}

TEST_F(NuScenes, PointsAreTurnedByTheLidarsYawAlone) {
  const DriveLog drive = nuscenes_drive(file(""), "scene-0001", strict_);
  const Point ahead = drive.T_body_points * Point(-3.0, 30.0, 0.0);  // 3 m to the left, 30 m ahead
  EXPECT_NEAR(ahead.x(), 30.94, 1e-2);
  EXPECT_NEAR(ahead.y(), 3.0, 1e-2);
  EXPECT_NEAR(ahead.z(), 1.84, 1e-9);
  EXPECT_EQ(drive.ground_z_m, 0.0);
}

TEST_F(NuScenes, RecordsThatAreWrongAreLeftOut) {
  const std::vector<std::pair<std::string, std::string>> wrongs{
      {"\"translation\":[102,7,0]", "\"translation\":[NaN,7,0]"},
      {"\"rotation\":[0,0,0,1]", "\"rotation\":[2,0,0,0]"},
      {"\"timestamp\":1510000", "\"timestamp\":-5"},
      {"\"timestamp\":1510000", "\"timestamp\":\"1510000\""},
      {"\"translation\"", "\"place\""}};
  for (const auto& [right, wrong] : wrongs) {
    std::string bad = pose("p2", 1'510'000, 102);
    bad.replace(bad.find(right), right.size(), wrong);
    write("ego_pose.json",
          "[" + pose("p3", 1'550'000, 103) + "," + bad + "," + pose("p1", 1'500'000, 101) + "]");
    LeftOut left_out;
    EXPECT_EQ(nuscenes_drive(file(""), "scene-0001", left_out).poses.size(), 2U) << wrong;
    EXPECT_THAT(left_out.summary(), HasSubstr("(first: ego_pose.json[1])")) << wrong;
    EXPECT_THAT(scene_error(), HasSubstr("ego_pose.json: [1]")) << wrong;
  }
}

TEST_F(NuScenes, WhatIsWrongIsNamed) {
  EXPECT_THAT(error([&] { nuscenes_drive(file(""), "scene-0099", strict_); }),
              HasSubstr("no scene scene-0099"));
  write("ego_pose.json", R"([{"token":"p1","timestamp":1500000,"rotation":[1,0,0],"translation":[0,0,0]}])");
  EXPECT_THAT(scene_error(), HasSubstr("ego_pose.json: [0].rotation: must be [w, x, y, z]"));
  write("ego_pose.json", "[]");
  EXPECT_THAT(scene_error(), HasSubstr("ego_pose.json: has fewer than two poses of scene-0001"));
  SetUp();
  write("sensor.json", R"([{"token":"cam","channel":"CAM_FRONT"}])");
  EXPECT_THAT(scene_error(), HasSubstr("LIDAR_TOP"));
  write("sample.json", "{}");
  EXPECT_THAT(scene_error(), HasSubstr("sample.json: must be an array"));
  std::filesystem::remove(file("sample.json"));
  EXPECT_THAT(scene_error(), HasSubstr("sample.json: cannot be read"));
}

}  // namespace
}  // namespace laneloom::imports
