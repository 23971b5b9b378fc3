#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <variant>

#include "base/degree.hpp"
#include "commands.hpp"
#include "io/axes.hpp"
#include "io/feather_writer.hpp"
#include "recording/recording.hpp"
#include "simulation/perception.hpp"
#include "simulation/road.hpp"
#include "simulation/scenarios.hpp"

namespace laneloom::imports {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Runs the real `laneloom import` on a made-up Argoverse 2 log of half a second.
class ImportCommand : public Commands {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(file("log"));
    std::ofstream poses(file("log/city_SE3_egovehicle.csv"));
    poses << "timestamp_ns,qw,qx,qy,qz,tx_m,ty_m,tz_m\n";
    for (int i = 0; i <= 5; ++i) poses << 1'000'000'000 + i * 100'000'000 << ",1,0,0,0," << i << ",0,0\n";
    write(
        "results.json",
        R"({"meta":{},"results":[)"
        R"({"sample_token":"log_1250000000","vectors":[)"
        R"({"cls_name":"divider","confidence_level":0.9,"pts":[[0,2,-0.3],[30,2,-0.3]],"pts_num":2,"type":0},)"
        R"({"cls_name":"ped_crossing","confidence_level":0.9,"pts":[[0,2,0],[1,2,0]],"pts_num":2,"type":1}]},)"
        R"({"sample_token":"log_1100000000","vectors":[]},{"sample_token":"log_1600000000","vectors":[]},)"
        R"({"sample_token":"another_1","vectors":[]}]})");
  }
  void write(const std::string& name, const std::string& content) { std::ofstream(file(name)) << content; }
  int run(const std::string& words) const override { return Commands::run("import " + words); }

  template <class Message>
  std::vector<Message> messages(const std::string& recording) const {
    recording::RecordingReader reader(file(recording));
    std::vector<Message> messages;
    while (const auto message = reader.next())
      if (const auto* one = std::get_if<Message>(&message->message)) messages.push_back(*one);
    EXPECT_TRUE(reader.refused().values().empty());
    return messages;
  }
  std::vector<MarkingType> types(const std::string& recording) const {
    std::vector<MarkingType> types;
    for (const DetectionFrame& frame : messages<DetectionFrame>(recording))
      for (const Detection& detection : frame.detections) types.push_back(detection.type);
    return types;
  }
};

/// A map of Argoverse 2 with one lane.
std::string one_lane_map() {
  const auto border = [](double y) {
    const std::string at = R"(,"y":)" + std::to_string(y) + R"(,"z":0})";
    return R"([{"x":0)" + at + R"(,{"x":20)" + at + "]";
  };
  return R"({"lane_segments":{"7":{"id":7,"is_intersection":false,"lane_type":"VEHICLE","successors":[],)"
         R"("left_lane_boundary":)" +
         border(1.75) + R"(,"left_lane_mark_type":"DASHED_WHITE","right_lane_boundary":)" + border(-1.75) +
         R"(,"right_lane_mark_type":"SOLID_WHITE"}},"drivable_areas":{}})";
}

TEST_F(ImportCommand, MapTrResultsOfALogBecomeARecording) {
  ASSERT_TRUE(done("maptr --results results.json --argoverse2 log --out drive.mcap"));
  EXPECT_THAT(output(), HasSubstr("log: 2 frames, 6 poses"));
  EXPECT_THAT(output(), HasSubstr("1 lines of class ped_crossing"));
  EXPECT_THAT(output(), HasSubstr("1 frames without poses"));
  EXPECT_THAT(output(), HasSubstr("1 frames of other drives"));

  const auto poses = messages<VehiclePose>("drive.mcap");
  ASSERT_EQ(poses.size(), 6u);
  EXPECT_EQ(poses.back().stamp_ns, 1'500'000'000);
  const auto frames = messages<DetectionFrame>("drive.mcap");
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].stamp_ns, 1'250'000'000);
  ASSERT_EQ(frames[1].detections.size(), 1u);
  EXPECT_EQ(frames[1].detections[0].points, (Polyline{{0, 2, -0.3}, {30, 2, -0.3}}));
}

TEST_F(ImportCommand, TheEndingOfARecordingNeedNotBeGiven) {
  const std::string words = "maptr --results results.json --argoverse2 log --out ";
  ASSERT_TRUE(done(words + "drive"));
  EXPECT_EQ(messages<VehiclePose>("drive.mcap").size(), 6u);
  EXPECT_EQ(run(words + "-"), 64);
  EXPECT_THAT(output(), HasSubstr("no standard output"));
}

TEST_F(ImportCommand, ClassesBecomeTheTypesThatAreSaid) {
  ASSERT_TRUE(
      done("maptr --results results.json --argoverse2 log --class ped_crossing=stopline --class divider=none "
           "--out drive.mcap"));
  EXPECT_THAT(output(), HasSubstr("1 lines of class divider"));
  EXPECT_EQ(types("drive.mcap"), std::vector{MarkingType::stopline});
  for (const std::string wrong : {"divider", "divider=kerb", "=none"}) {
    EXPECT_EQ(run("maptr --results results.json --argoverse2 log --class " + wrong + " --out x.mcap"), 64);
    EXPECT_THAT(output(), HasSubstr("needs NAME=laneline, roadedge, stopline or none"));
  }
}

TEST_F(ImportCommand, StreamMapNetAndMapTrackerNameSamplesByStamp) {
  write(
      "submission_vector.json",
      R"({"meta": {}, "results": {"1250000000": {"vectors": [[[0, 2], [30, 2]]], "scores": [0.9], "labels": [1]},)"
      R"("1900000000": {"vectors": [], "scores": [], "labels": []}}})");
  for (const std::string network : {"streammapnet", "maptracker"}) {
    const std::string recording = file(network + ".mcap");
    ASSERT_TRUE(done(network + " --results submission_vector.json --argoverse2 log --out " + recording));
    EXPECT_THAT(output(), HasSubstr("log: 1 frames, 6 poses"));
    EXPECT_THAT(output(), HasSubstr("1 frames of other drives"));
  }
}

class ImportOpenpilot : public ImportCommand {
 protected:
  static std::string pose(std::int64_t stamp_ns) {
    return R"({"logMonoTime":")" + std::to_string(stamp_ns) +
           R"(","livePose":{"orientationNED":{"x":0,"y":0,"z":0,"valid":true},)"
           R"("velocityDevice":{"x":10,"y":0,"z":0,"valid":true}}})" +
           "\n";
  }
  static std::string model(std::int64_t stamp_ns, const std::string& probability = "0.9") {
    const std::string line = R"({"x":[0,30],"y":[-1.8,-1.8],"z":[1.2,1.2]})";
    return R"({"logMonoTime":"2","modelV2":{"timestampEof":")" + std::to_string(stamp_ns) +
           R"(","laneLines":[)" + line + R"(],"laneLineProbs":[)" + probability +
           R"(],"laneLineStds":[0.1],"roadEdges":[],"roadEdgeStds":[]}})" + "\n";
  }
};

TEST_F(ImportOpenpilot, ALogBecomesARecording) {
  write("rlog.jsonl", pose(1'000'000'000) + pose(1'100'000'000) + model(1'050'000'000));
  ASSERT_TRUE(done("openpilot --log rlog.jsonl --out drive.mcap"));
  EXPECT_THAT(output(), HasSubstr("1 frames, 2 poses"));
  EXPECT_EQ(messages<DetectionFrame>("drive.mcap").size(), 1u);
}

TEST_F(ImportOpenpilot, AQlogThatHasFramesIsTold) {
  std::string poses, frames;
  for (std::int64_t stamp_ns = 1'000'000'000; stamp_ns <= 9'000'000'000; stamp_ns += 200'000'000)
    poses += pose(stamp_ns);
  for (const std::int64_t s : {2, 4, 6, 8}) frames += model(s * 1'000'000'000);
  write("qlog.jsonl", poses + frames);
  ASSERT_TRUE(done("openpilot --log qlog.jsonl --out drive.mcap"));
  const auto is_told = HasSubstr("qlog.jsonl: looks like a qlog, with a frame every 2.0 s; the rlog has all");
  EXPECT_THAT(output(), is_told);
  write("late.jsonl", pose(1) + pose(2) + model(2'000'000'000) +
                          R"({"logMonoTime":"3","drivingModelData":{}})"
                          "\n"
                          R"({"logMonoTime":"4","drivingModelData":{}})"
                          "\n"
                          R"({"logMonoTime":"5","drivingModelData":{}})"
                          "\n");
  EXPECT_EQ(run("openpilot --log late.jsonl --out none.mcap"), 1);
  EXPECT_THAT(output(), HasSubstr("late.jsonl: looks like a qlog, with 1 modelV2 beside 3 drivingModelData"));
  write("qlog.jsonl", pose(1) + pose(2) + frames);
  EXPECT_EQ(run("openpilot --log qlog.jsonl --out none.mcap"), 1);
  EXPECT_THAT(output(), is_told);
  EXPECT_THAT(output(), HasSubstr("no frame is within the poses"));
}

TEST_F(ImportOpenpilot, WhatCheckFindsInTheDriveIsTold) {
  std::string log;
  for (std::int64_t stamp_ns = 1'000'000'000; stamp_ns <= 9'000'000'000; stamp_ns += 50'000'000)
    log += pose(stamp_ns) + model(stamp_ns, "0.01");
  write("rlog.jsonl", log);
  ASSERT_TRUE(done("openpilot --log rlog.jsonl --out drive.mcap"));
  EXPECT_THAT(output(), HasSubstr("drive.mcap: `laneloom check` finds:"));
  EXPECT_THAT(output(), HasSubstr("Set mapper.preprocess.min_confidence"));
  EXPECT_THAT(output(), Not(HasSubstr("qlog")));
}

/// A drive through a town as the results of a network whose points have other axes, and as own tables.
class ImportOwnTables : public ImportCommand {
 protected:
  static constexpr const char* kAxes = "right-forward";

  void write_drive(double duration_s) {
    const simulation::Road road = simulation::make_scenario("town");
    simulation::Perception perception(road, simulation::noise_profile("none"), {}, 1);
    std::string poses = "timestamp_ns,qw,qx,qy,qz,tx_m,ty_m,tz_m\n", samples = "token,timestamp_ns\n",
                results;
    for (int i = 1; 0.1 * i < duration_s; ++i) {
      VehiclePose pose = road.drive.pose_at(0.1 * i);
      pose.stamp_ns = i * std::int64_t{100'000'000};
      const auto& at = pose.position;
      const auto& q = pose.orientation;
      poses += fmt::format("{},{},{},{},{},{},{},{}\n", pose.stamp_ns, q.w(), q.x(), q.y(), q.z(), at.x(),
                           at.y(), at.z());
      samples += fmt::format("s{},{}\n", i, pose.stamp_ns);
      results += fmt::format(R"({}{{"sample_token":"s{}","vectors":[{}]}})", results.empty() ? "" : ",", i,
                             vectors(perception.observe(pose)));
    }
    write("poses.csv", poses);
    write("samples.csv", samples);
    write("results.json", R"({"results":[)" + results + "]}");
  }
  static std::string vectors(const DetectionFrame& frame) {
    const Eigen::Matrix3d axes_from_body = io::axes_named(kAxes).transpose();
    std::string lines;
    for (const Detection& line : frame.detections) {
      std::string points;
      for (const Point& point : line.points) {
        const Point p = axes_from_body * point;
        points += fmt::format("{}[{},{},{}]", points.empty() ? "" : ",", p.x(), p.y(), p.z());
      }
      lines += fmt::format(R"({}{{"cls_name":"divider","confidence_level":0.9,"pts":[{}]}})",
                           lines.empty() ? "" : ",", points);
    }
    return lines;
  }
  bool import_with(const std::string& options) {
    return done("maptr --results results.json --poses poses.csv --samples samples.csv --out " +
                fmt::format("{}.mcap", ++drives_) + options);
  }

 private:
  int drives_ = 0;
};

TEST_F(ImportOwnTables, TheRemedyIsAnOptionOfTheSameImport) {
  write_drive(40.0);
  const auto names_the_axes =
      HasSubstr("let `laneloom import maptr --axes right-forward` write the drive anew");
  ASSERT_TRUE(import_with(""));
  EXPECT_THAT(output(), names_the_axes);
  ASSERT_TRUE(import_with(" --axes forward-right"));
  EXPECT_THAT(output(), names_the_axes) << "of the points in the file, and not of those in the recording";
  ASSERT_TRUE(import_with(" --axes right-forward"));
  EXPECT_THAT(output(), Not(HasSubstr("laneloom check")));
}

TEST_F(ImportOwnTables, ADriveThatIsTooShortToTellIsTold) {
  write_drive(2.0);
  ASSERT_TRUE(import_with(""));
  EXPECT_THAT(output(), HasSubstr("1.mcap: `laneloom check` finds:\n1. Advice: Too little is seen"));
}

TEST_F(ImportCommand, ClassesOfJsonLinesBecomeTheTypesThatAreSaid) {
  std::string lines;
  for (const std::string t : {"1", "1.1"})
    lines += R"({"t":)" + t + R"(,"pose":[0,0,0,0,0,0,1],"detections":[)" +
             R"({"type":"kerb","score":0.9,"points":[[0,2,0],[30,2,0]]},)" +
             R"({"type":"arrow","score":0.9,"points":[[5,0,0],[8,0,0]]}]})" + "\n";
  write("drive.frames.jsonl", lines);
  const std::string classes = " --class kerb=roadedge --class arrow=none";
  ASSERT_TRUE(done("frames drive.frames.jsonl --out drive.mcap" + classes));
  EXPECT_THAT(output(), Not(HasSubstr("left out")));
  EXPECT_EQ(types("drive.mcap"), std::vector(2, MarkingType::roadedge));

  EXPECT_EQ(run("frames drive.mcap --out again.mcap" + classes), 1);
  EXPECT_THAT(output(), HasSubstr("drive.mcap: a recording has laneloom's types; --class needs JSON lines"));
  EXPECT_EQ(run("openpilot --log x --out y --class kerb=roadedge"), 64);
  EXPECT_THAT(output(), HasSubstr("kerb=roadedge: the lists of lines are laneLines, roadEdges"));
}

TEST_F(ImportCommand, ObjectsKeepToTheFrameAndTheUnitOfThePoints) {
  std::string lines;
  for (const std::string t : {"1.1", "1"})
    lines += R"({"t":)" + t + R"(,"pose":[5,0,0,0,0,0,1],"detections":[],"objects":[{"id":7,"kind":"car",)" +
             R"("position":[-2000,30000,0],"heading":[0,1,0],"speed":8000,"width":1800}]})" + "\n";
  write("drive.frames.jsonl", lines);
  ASSERT_TRUE(done("frames drive.frames.jsonl --axes right-forward --point-scale 0.001 --out drive.mcap"));
  EXPECT_THAT(output(), HasSubstr("2 frames, 2 poses, 2 messages of objects"));
  const auto found = messages<TrackedObjects>("drive.mcap");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_LT(found[0].stamp_ns, found[1].stamp_ns);
  for (const TrackedObjects& message : found) {
    EXPECT_FALSE(message.in_map_frame);
    ASSERT_EQ(message.objects.size(), 1U);
    const TrackedObject& object = message.objects.front();
    EXPECT_TRUE(object.position.isApprox(Point(30, 2, 0))) << object.position.transpose();
    EXPECT_TRUE(object.heading.isApprox(Point(1, 0, 0))) << object.heading.transpose();
    EXPECT_DOUBLE_EQ(object.speed_mps, 8.0);
    EXPECT_DOUBLE_EQ(object.width_m, 1.8);
    EXPECT_DOUBLE_EQ(object.length_m, -1.0) << "not known";
  }
}

TEST_F(ImportCommand, ObjectsInTheMapFrameAreTakenToTheBodyFrame) {
  recording::RecordingWriter out(file("map_frame.mcap"));
  const Eigen::Quaterniond left(Eigen::AngleAxisd(90.0 * kDegree, Point::UnitZ()));
  for (const std::int64_t stamp_ns : {1'000'000'000, 1'100'000'000}) {
    out.write(VehiclePose{.stamp_ns = stamp_ns, .position = Point(5, 0, 0), .orientation = left}, stamp_ns);
    out.write(DetectionFrame{.stamp_ns = stamp_ns}, stamp_ns);
    out.write(TrackedObjects{.stamp_ns = stamp_ns + 50'000'000,
                             .objects = {{.id = 7, .position = {5, 10, 0}, .heading = {0, 1, 0}}},
                             .in_map_frame = true},
              stamp_ns);
    out.write(NextTurn{.stamp_ns = stamp_ns, .turn = Linkage::Turn::left, .distance_m = 40.0}, stamp_ns);
  }
  out.close();
  ASSERT_TRUE(done("frames map_frame.mcap --out drive.mcap"));
  EXPECT_EQ(messages<NextTurn>("drive.mcap").size(), 2U);
  const auto found = messages<TrackedObjects>("drive.mcap");
  ASSERT_EQ(found.size(), 1U) << "the other ones have no poses around them";
  EXPECT_FALSE(found[0].in_map_frame);
  ASSERT_EQ(found[0].objects.size(), 1U);
  const TrackedObject& object = found[0].objects.front();
  EXPECT_TRUE(object.position.isApprox(Point(10, 0, 0))) << object.position.transpose();
  EXPECT_TRUE(object.heading.isApprox(Point(1, 0, 0))) << object.heading.transpose();
}

TEST_F(ImportCommand, ATerminalShowsABar) {
  write("submission.json", R"({"results": {"1250000000": {"vectors": [], "scores": [], "labels": []}}})");
  write("frames.jsonl", R"({"t":1,"pose":[0,0,0,0,0,0,1],"detections":[]})");
  ASSERT_TRUE(done("frames frames.jsonl --out frames.mcap"));
  int number = 0;
  for (const std::string words :
       {"maptr --results results.json --argoverse2 log",
        "maptracker --results submission.json --argoverse2 log", "openpilot --log frames.jsonl",
        "frames frames.jsonl", "scene frames.mcap", "argoverse2 log"}) {
    const std::string out = std::to_string(++number) + ".mcap";
    shell("script -qec 'laneloom import " + words + " --out " + out + "' /dev/null");
    EXPECT_THAT(output(), HasSubstr("#] 100 %")) << words;
  }
}

TEST_F(ImportCommand, WhatIsWrongIsToldOnceAndStrictRefusesIt) {
  const std::string line = R"({"cls_name":"divider","confidence_level":0.9,"pts":[[0,2],[30,NaN]]})";
  const std::string right = R"({"cls_name":"divider","confidence_level":0.9,"pts":[[0,2],[30,2]]})";
  write("results.json", R"({"results":[{"sample_token":"log_1250000000","vectors":[)" + line + "," + line +
                            "," + right + "]}]}");
  const std::string maptr = "maptr --results results.json --argoverse2 log --out drive.mcap";
  EXPECT_EQ(run(maptr + " --strict"), 1);
  EXPECT_THAT(output(), HasSubstr("results.json: results[0].vectors[0].pts[1]: must be finite"));
  EXPECT_FALSE(exists("drive.mcap"));
  EXPECT_TRUE(done(maptr));
  EXPECT_THAT(output(), HasSubstr("results.json: left out: 2 x vectors[].pts[]: must be finite (first: "
                                  "results[0].vectors[0])\n"));
}

TEST_F(ImportCommand, AWrongRowIsToldWithItsFile) {
  std::filesystem::copy(file("log/city_SE3_egovehicle.csv"), file("poses.csv"));
  write("samples.csv", "token,timestamp_ns\nlog_1250000000,1250000000\nlog_1100000000,1.1\n");
  ASSERT_TRUE(done("maptr --results results.json --poses poses.csv --samples samples.csv --out drive.mcap"));
  EXPECT_THAT(output(), HasSubstr("laneloom: poses.csv and samples.csv: left out: 1 x a whole number is "
                                  "expected (first: samples.csv:3)\n"));
}

TEST_F(ImportCommand, ALogGivesItsMapAndItsPosesInTheSameFrame) {
  write("log/log_map_archive_x.json", one_lane_map());
  ASSERT_TRUE(done("argoverse2 log --out poses.mcap --truth truth.json"));

  const simulation::Road truth = simulation::load_truth(file("truth.json"));
  ASSERT_EQ(truth.markings.size(), 2u);
  EXPECT_EQ(truth.markings[0].style, MarkingStyle::dashed);
  EXPECT_EQ(truth.markings[0].points.front(), Point(0, 1.75, 0));
  ASSERT_EQ(truth.lanes.size(), 1u);
  recording::RecordingReader reader(file("poses.mcap"));
  const auto first = reader.next();
  ASSERT_TRUE(first);
  const auto& pose = std::get<VehiclePose>(first->message);
  EXPECT_EQ(pose.stamp_ns, 1'000'000'000) << "of the log, so that detections of the log fit to it";
  EXPECT_EQ(pose.position, Point(0, 0, 0));
  std::size_t poses = 1;
  while (reader.next()) ++poses;
  EXPECT_EQ(poses, 6u);

  EXPECT_EQ(run("argoverse2 log --out poses.mcap"), 1) << "it exists";
  EXPECT_NE(run("argoverse2 log"), 0);
  EXPECT_EQ(run("argoverse2 nowhere --truth x.json"), 1);
  EXPECT_THAT(output(), HasSubstr("nowhere"));
}

TEST_F(ImportCommand, TheObjectsOfALogComeBesideItsPoses) {
  std::vector<AnnotationRow> rows;
  for (const int sweep : {0, 1, 2, 3, 4, 5})
    rows.push_back({1'000'000'000 + sweep * 100'000'000, "a", "REGULAR_VEHICLE", 20.0});
  write_bytes(file("log/annotations.feather"), FeatherWriter(annotation_columns(rows)).write());
  ASSERT_TRUE(done("argoverse2 log --out drive.mcap"));
  EXPECT_THAT(output(), HasSubstr("6 poses, 6 sweeps with objects"));
  recording::RecordingReader reader(file("drive.mcap"));
  std::vector<std::int64_t> poses_ns, objects_ns;
  while (const auto message = reader.next()) {
    if (const auto* pose = std::get_if<VehiclePose>(&message->message)) poses_ns.push_back(pose->stamp_ns);
    const auto* objects = std::get_if<TrackedObjects>(&message->message);
    if (objects == nullptr) continue;
    objects_ns.push_back(objects->stamp_ns);
    EXPECT_EQ(poses_ns.back(), objects->stamp_ns) << "behind the pose of its stamp";
    EXPECT_EQ(objects->sequence, objects_ns.size());
    EXPECT_NEAR(objects->objects.at(0).speed_mps, 10.0, 1e-6);
  }
  EXPECT_TRUE(reader.refused().values().empty());
  EXPECT_EQ(objects_ns, poses_ns);

  rows.back().length_m = -1.0;
  write_bytes(file("log/annotations.feather"), FeatherWriter(annotation_columns(rows)).write());
  ASSERT_TRUE(done("argoverse2 log --out rest.mcap"));
  EXPECT_THAT(output(),
              HasSubstr("left out: 1 x a size of 0 or more is expected (first: annotations.feather: row 5)"));
  EXPECT_EQ(run("argoverse2 log --out strict.mcap --strict"), 1);
  EXPECT_FALSE(exists("strict.mcap"));
}

TEST_F(ImportCommand, ADirectoryOfLogsGivesAFileEach) {
  for (const std::string log : {"a", "b"}) {
    std::filesystem::create_directories(file("data/val/" + log));
    std::filesystem::copy(file("log/city_SE3_egovehicle.csv"), file("data/val/" + log));
  }
  ASSERT_TRUE(done("argoverse2 data --out poses"));
  EXPECT_TRUE(exists("poses/a.mcap"));
  EXPECT_TRUE(exists("poses/b.mcap"));

  std::filesystem::copy(file("data/val"), file("data/test"), std::filesystem::copy_options::recursive);
  ASSERT_TRUE(done("argoverse2 data --out again"));
  EXPECT_TRUE(exists("again/b.mcap"));
  EXPECT_THAT(output(), HasSubstr("data: left out: 2 x a second log of this name (first: val/a)"));
  EXPECT_EQ(run("argoverse2 data --out strict --strict"), 1);
  EXPECT_THAT(output(), HasSubstr("data/val/a: is a second log of this name"));
}

TEST_F(ImportCommand, ALogInSeveralSplitsIsTakenOnce) {
  const std::vector<std::vector<std::string>> layouts{
      {"train", "val"}, {"val", "test"}, {"test", "train"}, {"train", "val", "test"}, {"a/val", "b/val"}};
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    const std::string data = "data" + std::to_string(i), out = "out" + std::to_string(i);
    for (const std::string& split : layouts[i]) {
      std::filesystem::create_directories(file(data + "/" + split));
      std::filesystem::copy(file("log"), file(data + "/" + split + "/log"));
    }
    ASSERT_TRUE(done("argoverse2 " + data + " --out " + out));
    EXPECT_THAT(output(), HasSubstr(std::to_string(layouts[i].size() - 1) + " x a second log of this name"));
    EXPECT_TRUE(exists(out + "/log.mcap"));
  }
}

/// Makes data/val/log a copy of the log, and data/test/log one that lacks something.
class LogOfTwoSplits : public ImportCommand {
 protected:
  void SetUp() override {
    ImportCommand::SetUp();
    write("log/log_map_archive_x.json", one_lane_map());
    std::vector<AnnotationRow> rows;
    for (const int sweep : {0, 1, 2, 3, 4, 5})
      rows.push_back({1'000'000'000 + sweep * 100'000'000, "a", "REGULAR_VEHICLE", 20.0});
    write_bytes(file("log/annotations.feather"), FeatherWriter(annotation_columns(rows)).write());
    for (const std::string split : {"test", "val"}) {
      std::filesystem::create_directories(file("data/" + split));
      std::filesystem::copy(file("log"), file("data/" + split + "/log"));
    }
  }
  void expect_that_val_is_taken() {
    ASSERT_TRUE(done("argoverse2 data --out drives --truth truths"));
    EXPECT_THAT(output(), HasSubstr("1 x a second log of this name (first: test/log)"));
    EXPECT_THAT(output(), HasSubstr("data/val/log: 6 poses, 6 sweeps with objects"));
    EXPECT_EQ(simulation::load_truth(file("truths/log.truth.json")).lanes.size(), 1U);
  }
};

TEST_F(LogOfTwoSplits, TheOneWithAnnotationsIsTaken) {
  std::filesystem::remove(file("data/test/log/annotations.feather"));
  expect_that_val_is_taken();
}

TEST_F(LogOfTwoSplits, TheOneWithAMapIsTaken) {
  std::filesystem::remove(file("data/test/log/log_map_archive_x.json"));
  expect_that_val_is_taken();
}

TEST_F(LogOfTwoSplits, TheOneWhosePosesCanBeReadIsTaken) {
  write("data/test/log/city_SE3_egovehicle.csv",
        "timestamp_ns,qw,qx,qy,qz,tx_m,ty_m,tz_m\n1000000000,1,0,0,");
  expect_that_val_is_taken();
}

TEST_F(LogOfTwoSplits, TheOneWhoseMapCanBeReadIsTaken) {
  write("data/test/log/log_map_archive_x.json", one_lane_map().substr(0, 200));
  expect_that_val_is_taken();
}

TEST_F(LogOfTwoSplits, TheOneWhoseAnnotationsCanBeReadIsTaken) {
  std::filesystem::resize_file(file("data/test/log/annotations.feather"), 100);
  expect_that_val_is_taken();
}

TEST_F(LogOfTwoSplits, TheOneWithoutAnnotationsIsTakenBeforeOneWhoseAnnotationsAreBroken) {
  std::filesystem::remove(file("data/val/log/annotations.feather"));
  std::filesystem::resize_file(file("data/test/log/annotations.feather"), 100);
  ASSERT_TRUE(done("argoverse2 data --out drives"));
  EXPECT_THAT(output(), HasSubstr("data/val/log: 6 poses, 0 sweeps with objects"));
}

TEST_F(ImportCommand, ALogThatIsBrokenDoesNotEndTheImportOfTheOthers) {
  for (const std::string log : {"a", "b", "c"}) {
    std::filesystem::create_directories(file("data/val"));
    std::filesystem::copy(file("log"), file("data/val/" + log));
  }
  write("data/val/a/annotations.feather", "ARROW");
  write("data/val/b/city_SE3_egovehicle.csv", "");
  EXPECT_EQ(run("argoverse2 data --out strict --strict"), 1);
  EXPECT_THAT(output(), HasSubstr("data/val/a/annotations.feather: "));
  ASSERT_TRUE(done("argoverse2 data --out drives"));
  EXPECT_THAT(output(), HasSubstr("data/val/a/annotations.feather: "));
  EXPECT_THAT(output(), HasSubstr("data/val/b/city_SE3_egovehicle.csv: "));
  EXPECT_THAT(output(), HasSubstr("; the log is left out"));
  EXPECT_TRUE(exists("drives/c.mcap"));
  EXPECT_FALSE(exists("drives/a.mcap"));

  EXPECT_EQ(run("argoverse2 data --truth truths"), 1) << "no log has a map";
  EXPECT_THAT(output(), HasSubstr("data: no log of it can be read"));
  EXPECT_EQ(run("argoverse2 data --out drives"), 1) << "an output that is there is no fault of a log";
}

TEST_F(ImportCommand, NoTruthIsLeftBehindWhereTheRecordingFails) {
  write("log/log_map_archive_x.json", one_lane_map());
  write("there.mcap", "");
  EXPECT_EQ(run("argoverse2 log --out there.mcap --truth truth.json"), 1);
  EXPECT_FALSE(exists("truth.json"));
}

TEST_F(ImportCommand, WrongUseAndInputAreNamed) {
  const std::string maptr = "maptr --argoverse2 log --out drive.mcap --results ";
  EXPECT_EQ(run(maptr + "missing.json"), 1);
  EXPECT_THAT(output(), HasSubstr("missing.json: cannot be read"));
  write("late.json", R"({"results":[{"sample_token":"log_1600000000","vectors":[]}]})");
  EXPECT_EQ(run(maptr + "late.json"), 1);
  EXPECT_THAT(output(), HasSubstr("no sample is within the poses"));
  EXPECT_FALSE(exists("drive.mcap"));
  EXPECT_EQ(run("streammapnet --results results.json --argoverse2 log --out drive.mcap"), 1);
  EXPECT_THAT(output(), HasSubstr("results.json: results: must be an object; results of MapTR have a list"));
  EXPECT_NE(run("maptr --results results.json --nuscenes log --out x"), 0);
  EXPECT_THAT(output(), HasSubstr("--scene"));
  EXPECT_NE(run(""), 0);
}

}  // namespace
}  // namespace laneloom::imports
