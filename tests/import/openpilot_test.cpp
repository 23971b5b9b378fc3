#include "import/openpilot.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::imports {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kLine = R"({"x": [0, 10], "y": [-1.5, -1], "z": [1.2, 1.3], "t": ["NaN", 0]})";
constexpr const char* kEdge = R"({"x": [0, 10], "y": [4, 4], "z": [1.2, 1.2], "t": []})";

std::string model(std::int64_t stamp_ns, const std::string& line = kLine,
                  const std::string& probabilities = "[0.75]") {
  return fmt::format(
      R"({{"logMonoTime": "7", "valid": true, "modelV2": {{"frameId": 3, "timestampEof": "{}", "laneLines": [{}],)"
      R"("laneLineProbs": {}, "laneLineStds": [0.25], "roadEdges": [{}, {}], "roadEdgeStds": [0.5, 3]}}}})",
      stamp_ns, line, probabilities, kEdge, kEdge);
}

/// Roll, pitch and yaw, and the velocity forward.
std::string pose(std::int64_t stamp_ns, double yaw_rad, double speed_mps, bool valid = true) {
  return fmt::format(
      R"({{"logMonoTime": "{}", "valid": true, "livePose": {{"orientationNED": {{"x": 0, "y": 0, "z": {}, "valid": {}}},)"
      R"("velocityDevice": {{"x": {}, "y": 0, "z": 0, "valid": true}}}}}})",
      stamp_ns, yaw_rad, valid, speed_mps);
}

class Openpilot : public testing::Test {
 protected:
  OpenpilotDrive read(const std::vector<std::string>& events, bool strict = false) {
    return read_text(fmt::format("{}\n", fmt::join(events, "\n")), strict);
  }
  OpenpilotDrive read_text(const std::string& text, bool strict = false) {
    std::ofstream(folder_.file("rlog.jsonl")) << text;
    left_out_ = LeftOut(strict);
    return read_openpilot(folder_.file("rlog.jsonl"), {left_out_, classes_});
  }
  std::string left_out() const { return left_out_.summary(); }
  /// What a strict reader says.
  std::string error(const std::vector<std::string>& events) {
    return thrown_by([&] { read(events, true); });
  }
  template <typename Read>
  static std::string error_of(Read read) {
    return thrown_by([&] { read(); });
  }

 private:
  TemporaryFolder folder_;
  LeftOut left_out_;

 protected:
  Classes classes_ = openpilot_classes();
};

TEST_F(Openpilot, LinesAndEdgesWithTheirProbabilitiesAndDeviations) {
  const OpenpilotDrive drive = read({R"({"logMonoTime": "1", "carState": {"vEgo": 3}})", model(200),
                                     model(100), pose(1, 0, 0), pose(1'000'000'000, 0, 0)});
  ASSERT_EQ(drive.frames.size(), 2u);
  EXPECT_EQ(drive.frames[0].stamp_ns, 100) << "by stamp, not in the order of the log";
  const auto& detections = drive.frames[0].detections;
  ASSERT_EQ(detections.size(), 3u);
  EXPECT_EQ(detections[0].type, MarkingType::laneline);
  EXPECT_EQ(detections[0].confidence, 0.75);
  EXPECT_THAT(detections[0].stddev_m, ElementsAre(0.25, 0.25));
  EXPECT_TRUE(detections[0].points[1].isApprox(Point(10, 1, -1.3))) << "x forward, y left, z up";
  EXPECT_EQ(detections[1].type, MarkingType::roadedge);
  EXPECT_EQ(detections[1].confidence, 0.5);
  EXPECT_EQ(detections[2].confidence, 0.0);
}

TEST_F(Openpilot, ListsBecomeTheTypesThatAreSaid) {
  classes_["roadEdges"] = std::nullopt;
  classes_["laneLines"] = MarkingType::roadedge;
  const OpenpilotDrive drive = read({model(100), pose(1, 0, 0), pose(200, 0, 0)});
  ASSERT_EQ(drive.frames.at(0).detections.size(), 1u);
  EXPECT_EQ(drive.frames[0].detections[0].type, MarkingType::roadedge);
  EXPECT_THAT(drive.frames[0].detected_types, ElementsAre(MarkingType::roadedge));
}

TEST_F(Openpilot, AListThatIsNotThereIsAsAnEmptyOne) {
  const auto changed = [](const auto& change) {
    nlohmann::json event = nlohmann::json::parse(model(100));
    change(event["modelV2"]);
    return event.dump();
  };
  const std::map<std::string, std::size_t> lines_without{
      {"laneLines", 2}, {"laneLineProbs", 2}, {"laneLineStds", 2}, {"roadEdges", 1}, {"roadEdgeStds", 1}};
  for (const auto& [key, lines] : lines_without) {
    const std::string absent = changed([&list = key](auto& model) { model.erase(list); });
    const std::string empty = changed([&list = key](auto& model) { model[list] = nlohmann::json::array(); });
    EXPECT_EQ(read({absent, pose(1, 0, 0), pose(200, 0, 0)}).frames.at(0).detections.size(), lines) << key;
    const std::string told = left_out();
    EXPECT_EQ(read({empty, pose(1, 0, 0), pose(200, 0, 0)}).frames.at(0).detections.size(), lines) << key;
    EXPECT_EQ(told, left_out()) << key;
  }
  const std::string neither = changed([](auto& model) {
    model.erase("laneLines");
    model.erase("roadEdges");
  });
  EXPECT_THAT(error({neither}), HasSubstr("modelV2.laneLines: is missing"));
}

TEST_F(Openpilot, PosesAreTheSumOfTheVelocities) {
  const double east = std::numbers::pi / 2;
  const OpenpilotDrive drive =
      read({model(100), pose(1, 0, 10), pose(1'000'000'001, 0, 10), pose(3'000'000'001, east, 10)});
  ASSERT_EQ(drive.poses.size(), 3u);
  EXPECT_TRUE(drive.poses[0].position.isZero());
  EXPECT_TRUE(drive.poses[1].position.isApprox(Point(10, 0, 0))) << "north is x";
  EXPECT_TRUE(drive.poses[2].position.isApprox(Point(20, -10, 0))) << "east is -y";
  EXPECT_TRUE((transform(drive.poses[2]).linear() * Point::UnitX()).isApprox(-Point::UnitY()));
  EXPECT_TRUE((transform(drive.poses[2]).linear() * Point::UnitZ()).isApprox(Point::UnitZ()));
}

TEST_F(Openpilot, TheCalibrationTurnsTheDeviceIntoTheRoad) {
  const std::string calibration =
      R"({"logMonoTime": "5", "liveCalibration": {"calStatus": "calibrated", "rpyCalib": [0, 0.1, 0]}})";
  const OpenpilotDrive drive = read({model(100), pose(1, 0, 1), pose(10, 0, 1), calibration});
  // The calibrated frame is pitched up by 0.1 against the device: forward goes up.
  const Point forward = transform(drive.poses[0]).linear() * Point::UnitX();
  EXPECT_NEAR(forward.z(), std::sin(0.1), 1e-9);
  const std::string unknown =
      R"({"logMonoTime": "5", "liveCalibration": {"calStatus": "uncalibrated", "rpyCalib": []}})";
  EXPECT_TRUE(read({model(100), pose(1, 0, 1), pose(10, 0, 1), unknown})
                  .poses[0]
                  .orientation.isApprox(Eigen::Quaterniond::Identity()));
}

TEST_F(Openpilot, OlderLogsHaveListsInsteadOfNames) {
  const auto older = [](int stamp_ns) {
    return fmt::format(
        R"({{"logMonoTime": {}, "liveLocationKalman": {{"orientationNED": {{"value": [0, 0, 0],)"
        R"("std": [], "valid": true}}, "velocityDevice": {{"value": [1, 0, 0], "valid": true}}}}}})",
        stamp_ns);
  };
  EXPECT_EQ(read({model(100), older(1), older(1'000'000'001)}).poses[1].position, Point(1, 0, 0));
}

TEST_F(Openpilot, WhatOpenpilotDoesNotBelieveIsCounted) {
  std::string invalid = model(300);
  invalid.replace(invalid.find("true"), 4, "false");
  const OpenpilotDrive drive =
      read({model(100), invalid, pose(1, 0, 1), pose(2, 0, 1, false), pose(3, 0, 1)});
  EXPECT_EQ(drive.frames.size(), 1u);
  EXPECT_EQ(drive.poses.size(), 2u);
  EXPECT_EQ(drive.invalid_frames, 1u);
  EXPECT_EQ(drive.invalid_poses, 1u);
}

TEST_F(Openpilot, WhatIsWrongIsNamed) {
  EXPECT_THAT(error({model(100, R"({"x": [0], "y": [0, 1], "z": [0, 1]})")}),
              HasSubstr("rlog.jsonl:1: modelV2.laneLines[0]: x, y and z must be equally many"));
  EXPECT_THAT(error({pose(1, 0, 0), model(100, kLine, "[]")}),
              HasSubstr("rlog.jsonl:2: modelV2.laneLines[0]: has no value in laneLineProbs"));
  EXPECT_THAT(error({model(100, kLine, "[1.5]")}), HasSubstr("laneLines[0]: must be from 0 to 1"));
  EXPECT_THAT(error({model(100), pose(7, 0, 0), pose(7, 0, 0)}), HasSubstr(":3: livePose: a second pose"));
  EXPECT_THAT(error({model(100), model(100)}), HasSubstr(":2: modelV2.timestampEof: a second frame"));
  EXPECT_THAT(error({model(0)}), HasSubstr("refuse this frame: stamp"));
  EXPECT_THAT(error({R"({"logMonoTime": "x"})"}), HasSubstr(":1: logMonoTime: must be an integer"));
  EXPECT_THAT(error({"{}"}), HasSubstr("logMonoTime: is missing"));
  EXPECT_THAT(error({"[]"}), HasSubstr(":1: must be an object"));
  EXPECT_THAT(error({"{"}), HasSubstr(":1: "));
  EXPECT_THAT(error({pose(1, 0, 0)}), HasSubstr("has no modelV2"));
  EXPECT_THAT(error({model(100), pose(1, 0, 0)}), HasSubstr("fewer than two valid livePose"));
  EXPECT_THAT(error({model(100), pose(1, 0, 1e12), pose(1'000'000'001, 0, 1e12)}),
              HasSubstr("velocityDevice: is too fast"));
  EXPECT_THAT(error({model(100), pose(-1, 0, 1), pose(1, 0, 1)}), HasSubstr("refuse a pose: stamp"));
}

TEST_F(Openpilot, WhatIsWrongIsLeftOutAndTheRestComes) {
  const std::string nan = R"({"x": [0, 10], "y": [-1.5, -nan], "z": [1.2, 1.3]})";
  const std::string as_text = R"({"x": [0, 10], "y": [-1.5, "NaN"], "z": [1.2, 1.3]})";
  const OpenpilotDrive drive = read({pose(1, 0, 1), "}", model(100), model(200, nan), model(300, as_text),
                                     model(0), "{}", pose(5, 0, 1e12), pose(400, 0, 1)});
  ASSERT_EQ(drive.frames.size(), 3u);
  EXPECT_EQ(drive.frames[0].detections.size(), 3u);
  EXPECT_EQ(drive.frames[1].detections.size(), 2u) << "the road edges";
  EXPECT_EQ(drive.poses.size(), 2u);
  EXPECT_EQ(left_out(),
            "1 x is not JSON (first: line 2), "
            "2 x laneLines[].y[]: must be finite (first: line 4: modelV2.laneLines[0]), "
            "1 x modelV2: the service would refuse this frame: stamp (first: line 6), "
            "1 x logMonoTime: is missing (first: line 7), "
            "1 x livePose.velocityDevice: is too fast (first: line 8)");
}

TEST_F(Openpilot, WhereEveryLineIsWrongNothingIsLeft) {
  classes_["roadEdges"] = std::nullopt;
  const auto complaint = [&](const std::string& probabilities) {
    return thrown_by([&] { read({pose(1, 0, 1), model(100, kLine, probabilities), pose(200, 0, 1)}); });
  };
  EXPECT_THAT(complaint("[75]"), HasSubstr("rlog.jsonl: no line is left, as lines are wrong"));
  EXPECT_EQ(complaint("[0.75]"), "");
}

TEST_F(Openpilot, EventsThatComeTwiceAreTakenOnce) {
  const OpenpilotDrive drive =
      read({pose(1, 0, 1), model(100), model(100), pose(200, 0, 1), pose(200, 0, 1), model(100)});
  EXPECT_EQ(drive.frames.size(), 1u);
  EXPECT_EQ(drive.poses.size(), 2u);
  EXPECT_EQ(left_out(),
            "2 x modelV2.timestampEof: a second frame of this stamp (first: line 3), "
            "1 x livePose: a second pose of this stamp (first: line 5)");
}

TEST_F(Openpilot, ALastLineThatIsCutOffIsNamed) {
  const std::string whole = fmt::format("{}\n{}\n{}\n", pose(1, 0, 1), pose(200, 0, 1), model(100));
  EXPECT_EQ(read_text(whole + model(150).substr(0, 100)).frames.size(), 1u);
  EXPECT_EQ(left_out(), "1 x the last line is cut off (first: line 4)");
  EXPECT_EQ(read_text(whole + model(150)).frames.size(), 2u) << "a last line without its end";
  EXPECT_EQ(left_out(), "");
  EXPECT_THAT(thrown_by([&] { read_text(whole + "{", true); }), HasSubstr(":4: is not JSON"));
}

TEST_F(Openpilot, ALogMayBeCutOffAnywhere) {
  const std::string whole = fmt::format("{}\n{}\n{}\n", pose(1, 0, 1), pose(200, 0, 1), model(100));
  const std::string last = model(150);
  for (std::size_t size = 1; size < last.size(); ++size) {
    EXPECT_EQ(read_text(whole + last.substr(0, size)).frames.size(), 1u) << size;
    EXPECT_EQ(left_out(), "1 x the last line is cut off (first: line 4)") << size;
  }
}

TEST_F(Openpilot, EveryEventMayComeTwice) {
  const std::vector<std::string> log{pose(1, 0, 1), model(100), pose(200, 0, 1), model(300), pose(400, 0, 1)};
  const auto same_drive = [&](std::vector<std::string> events, std::size_t begin, std::size_t end) {
    const auto from = log.begin();
    events.insert(events.end(), from + static_cast<std::ptrdiff_t>(begin),
                  from + static_cast<std::ptrdiff_t>(end));
    const OpenpilotDrive drive = read(events);
    EXPECT_EQ(drive.frames.size(), 2u);
    EXPECT_EQ(drive.poses.size(), 3u);
    EXPECT_THAT(left_out(), HasSubstr("of this stamp"));
  };
  for (std::size_t i = 0; i < log.size(); ++i) {
    SCOPED_TRACE(i);
    same_drive(log, i, i + 1);
    same_drive(log, 0, i + 1);  // segments that overlap
  }
}

TEST_F(Openpilot, LinesMayBeMoreThanTheirProbabilities) {
  for (std::size_t lines = 1; lines <= 6; ++lines)
    for (std::size_t sure = 0; sure <= 4; ++sure) {
      const std::vector<std::string> all(lines, kLine);
      const std::vector<std::string> probabilities(sure, "0.75"), deviations(sure, "0.25");
      std::string frame = model(100, fmt::format("{}", fmt::join(all, ",")),
                                fmt::format("[{}]", fmt::join(probabilities, ",")));
      frame.replace(frame.find("[0.25]"), 6, fmt::format("[{}]", fmt::join(deviations, ",")));
      const OpenpilotDrive drive = read({pose(1, 0, 1), frame, pose(200, 0, 1)});
      EXPECT_EQ(drive.frames.at(0).detections.size(), std::min(lines, sure) + 2u)
          << lines << " lines, " << sure << " probabilities, and two road edges";
      EXPECT_EQ(left_out().empty(), lines <= sure);
    }
}

TEST_F(Openpilot, LinesWithoutAProbabilityAreLeftOut) {
  const std::string three = fmt::format("{0}, {0}, {0}", kLine);
  const OpenpilotDrive drive = read({pose(1, 0, 1), model(100, three), pose(200, 0, 1)});
  EXPECT_EQ(drive.frames.at(0).detections.size(), 3u) << "the first, and two road edges";
  EXPECT_EQ(left_out(),
            "2 x laneLines[]: has no value in laneLineProbs (first: line 2: modelV2.laneLines[1])");
}

TEST_F(Openpilot, ALogThatIsCutOffInItsFirstModelIsNoQlog) {
  const std::string cut = model(100).substr(0, 200);
  const std::string smaller = R"({"logMonoTime": "7", "drivingModelData": {"frameId": 1}})"
                              "\n";
  const auto complaint = [&](const std::string& text) { return thrown_by([&] { read_text(text); }); };
  for (const std::string& before : {pose(1, 0, 1) + "\n", pose(1, 0, 1) + "\n" + smaller}) {
    EXPECT_THAT(complaint(before + cut), HasSubstr("has no modelV2 before the place where it is cut off"));
    EXPECT_THAT(complaint(before + cut), Not(HasSubstr("qlog")));
  }
  EXPECT_THAT(complaint(smaller + smaller + cut), HasSubstr("is a qlog: it has drivingModelData"));
}

TEST_F(Openpilot, ALogWithFewModelsBesideManySmallerOnesLooksLikeAQlog) {
  const std::string smaller = R"({"logMonoTime": "7", "drivingModelData": {"frameId": 1}})";
  const std::vector<std::string> whole{pose(1, 0, 1), model(100), model(150),
                                       smaller,       smaller,    pose(200, 0, 1)};
  EXPECT_EQ(why_qlog(read(whole)), "");
  std::vector<std::string> qlog{pose(1, 0, 1), model(100), pose(200, 0, 1)};
  qlog.insert(qlog.end(), 20, smaller);
  EXPECT_EQ(why_qlog(read(qlog)),
            "looks like a qlog, with 1 modelV2 beside 20 drivingModelData; the rlog has all frames");
}

TEST_F(Openpilot, FilesOfAnotherKindAreNamed) {
  const auto complaint = [&](const std::string& text) { return thrown_by([&] { read_text(text); }); };
  const std::string qlog = R"({"logMonoTime": "7", "drivingModelData": {"frameId": 1}})";
  EXPECT_THAT(complaint(qlog),
              HasSubstr("is a qlog: it has drivingModelData, and no modelV2; the rlog is needed"));
  EXPECT_THAT(complaint(R"({"logMonoTime": "7", "carState": {}})"), HasSubstr("has no modelV2, as qlogs"));
  EXPECT_THAT(complaint("{\n\"logMonoTime\": \"7\"\n}\n"), HasSubstr("has no event of openpilot; the rlog"));
  EXPECT_THAT(complaint("\x28\xb5\x2f\xfd..."), HasSubstr("is compressed with zstd; the rlog is needed"));
  EXPECT_THAT(complaint(std::string(40, '\0')), HasSubstr("is binary"));
  EXPECT_THAT(complaint(std::string("\xff\xfe{\0", 4)),
              HasSubstr("is text in UTF-16, not in UTF-8; the rlog"));
  EXPECT_THAT(complaint(""), HasSubstr("rlog.jsonl: is empty"));
  EXPECT_THAT(thrown_by([&] {
                LeftOut left_out;
                read_openpilot("/no/such/log", {left_out});
              }),
              HasSubstr("/no/such/log: cannot be read"));
}

}  // namespace
}  // namespace laneloom::imports
