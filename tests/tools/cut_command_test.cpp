#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "commands.hpp"
#include "io/json_lines.hpp"
#include "recording/recording.hpp"

namespace laneloom {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

class CutCommand : public Commands {
 protected:
  void SetUp() override { simulate("none", "in.frames.jsonl"); }

  json info(const std::string& name) const {
    EXPECT_TRUE(done("info --json " + name));
    return json::parse(output());
  }
};

TEST_F(CutCommand, LinesKeepTheirTextAndTheTimeIsHalfOpen) {
  const std::string whole = text("in.frames.jsonl");
  ASSERT_TRUE(done("cut in.frames.jsonl --from 2 --to 3.5 --out a.jsonl"));
  const std::string part = text("a.jsonl");
  EXPECT_EQ(lines_of(part), 15u);
  EXPECT_THAT(whole, HasSubstr(part));
  EXPECT_EQ(json::parse(part.substr(0, part.find('\n'))).at("stamp_ns"), 2'100'000'000)
      << "the first is at 0.1 s";
}

TEST_F(CutCommand, AllPartsTogetherAreTheDrive) {
  ASSERT_TRUE(done("cut in.frames.jsonl --to 4 --out a.jsonl"));
  ASSERT_TRUE(done("cut in.frames.jsonl --from 4 --out b.jsonl"));
  EXPECT_EQ(text("a.jsonl") + text("b.jsonl"), text("in.frames.jsonl"));
}

TEST_F(CutCommand, OfARecordingTopicsAndTimeAreKeptWithTheConfiguration) {
  ASSERT_TRUE(done("replay in.frames.jsonl --out maps.mcap"));
  ASSERT_TRUE(done("cut maps.mcap --topic lane_map --to 5 --out part.mcap"));
  const json whole = info("maps.mcap"), part = info("part.mcap");
  ASSERT_EQ(part.at("topics").size(), 1u);
  EXPECT_EQ(part.at("topics").begin()->at("messages"), 50);
  EXPECT_EQ(part.at("configuration"), whole.at("configuration"));
  EXPECT_NE(part.at("configuration"), "");
}

TEST_F(CutCommand, SecondsCountFromTheFirstMessageOfARecordingForLinesToo) {
  constexpr std::int64_t kOtherClock_ns = 7'000'000'000'000;  // that of the computer is ahead of the sensors'
  {
    recording::RecordingWriter writer(file("late.mcap"));
    io::JsonLinesReader frames(file("in.frames.jsonl"));
    writer.write(ServiceStatus{.published_ns = kOtherClock_ns}, kOtherClock_ns);
    while (const auto record = frames.next_frame()) {
      writer.write(record->pose, kOtherClock_ns + record->pose.stamp_ns);
      writer.write(record->frame, kOtherClock_ns + record->frame.stamp_ns);
    }
    writer.close();
  }
  ASSERT_TRUE(done("cut late.mcap --to 1.05 --out a.frames.jsonl"));
  EXPECT_EQ(lines_of(text("a.frames.jsonl")), 10u) << "from 0.1 s to 1 s";
  ASSERT_TRUE(done("cut late.mcap --to 1.05 --topic detections --out a.mcap"));
  EXPECT_THAT(output(), HasSubstr("10 messages"));
}

TEST_F(CutCommand, ObjectsOfOthersAreATopic) {
  ASSERT_TRUE(done("simulate --scenario town --traffic usual --duration 2 --frames t.frames.jsonl"));
  ASSERT_TRUE(done("cut t.frames.jsonl --out t.mcap"));
  ASSERT_TRUE(done("cut t.mcap --topic objects --out objects.mcap"));
  EXPECT_THAT(output(), HasSubstr("20 messages"));
}

TEST_F(CutCommand, ObjectsOfARecordingAreInItsLines) {
  ASSERT_TRUE(done("simulate --scenario town --traffic usual --duration 2 --frames t.frames.jsonl"));
  ASSERT_TRUE(done("cut t.frames.jsonl --out t.mcap"));
  ASSERT_TRUE(done("cut t.mcap --out back.frames.jsonl"));
  io::JsonLinesReader whole(file("t.frames.jsonl")), back(file("back.frames.jsonl"));
  while (const auto expected = whole.next_frame()) {
    const auto got = back.next_frame();
    ASSERT_TRUE(got && got->objects && expected->objects);
    ASSERT_EQ(got->objects->objects.size(), expected->objects->objects.size());
    for (std::size_t i = 0; i < got->objects->objects.size(); ++i) {
      EXPECT_EQ(got->objects->objects[i].id, expected->objects->objects[i].id);
      EXPECT_TRUE(got->objects->objects[i].position.isApprox(expected->objects->objects[i].position, 1e-9));
    }
  }
}

TEST_F(CutCommand, ObjectsAndTurnsBetweenFramesGoOnToTheNextOne) {
  {
    recording::RecordingWriter writer(file("drive.mcap"));
    const auto at = [](int tenths) { return std::int64_t{1'000'000'000} + tenths * 100'000'000; };
    for (int i = 0; i <= 4; ++i)  // the vehicle drives 1 m from pose to pose
      writer.write(VehiclePose{.stamp_ns = at(i), .position = Point(i, 0, 0)}, at(i));
    for (const int i : {0, 1})  // a car ahead goes with 20 m/s
      writer.write(TrackedObjects{.stamp_ns = at(i),
                                  .objects = {{.id = 7,
                                               .position = Point(30, 2, 0),
                                               .heading = Point::UnitX(),
                                               .speed_mps = 20}}},
                   at(4));
    for (const int i : {0, 1})
      writer.write(NextTurn{.stamp_ns = at(i), .turn = Linkage::Turn::left, .distance_m = 50.0}, at(4));
    for (const int i : {2, 3})
      writer.write(DetectionFrame{.stamp_ns = at(i), .sequence = static_cast<std::uint64_t>(i)}, at(4));
    writer.close();
  }
  ASSERT_TRUE(done("cut drive.mcap --out drive.frames.jsonl"));
  io::JsonLinesReader lines(file("drive.frames.jsonl"));
  const auto first = lines.next_frame(), second = lines.next_frame();
  ASSERT_TRUE(first && second && first->objects);
  ASSERT_EQ(first->objects->objects.size(), 1u) << "the newest alone";
  EXPECT_TRUE(first->objects->objects[0].position.isApprox(Point(31, 2, 0)))
      << "by 2 m, and the vehicle by 1 m";
  ASSERT_TRUE(first->next_turn);
  EXPECT_NEAR(first->next_turn->distance_m, 49.0, 1e-9) << "the vehicle has come nearer";
  EXPECT_FALSE(second->objects) << "each is told once";
  EXPECT_FALSE(second->next_turn);
}

TEST_F(CutCommand, ARecordingBecomesLinesAndLinesARecording) {
  ASSERT_TRUE(done("cut in.frames.jsonl --out drive.mcap"));
  ASSERT_TRUE(done("cut drive.mcap --out back.frames.jsonl"));
  ASSERT_TRUE(done("replay in.frames.jsonl --report a.json"));
  ASSERT_TRUE(done("replay back.frames.jsonl --report b.json"));
  EXPECT_EQ(json_of("a.json").at("frames"), json_of("b.json").at("frames"));
  EXPECT_EQ(lines_of(text("back.frames.jsonl")), 80u);

  ASSERT_TRUE(done("replay in.frames.jsonl --out maps.mcap"));
  ASSERT_TRUE(done("cut maps.mcap --topic lane_map --out maps.jsonl"));
  EXPECT_THAT(text("maps.jsonl"), HasSubstr("\"lanes\""));
}

TEST_F(CutCommand, APartWithNothingInItIsAnError) {
  EXPECT_EQ(run("cut in.frames.jsonl --from 100 --out a.jsonl"), 1);
  EXPECT_THAT(output(), HasSubstr("nothing of it is in that part"));
  EXPECT_EQ(run("cut in.frames.jsonl --from 100 --out a.mcap"), 1);
  EXPECT_FALSE(exists("a.mcap")) << "it would be in the way of the next attempt";
  EXPECT_EQ(run("cut in.frames.jsonl --from 3 --to 2 --out a.jsonl"), 64);
  EXPECT_EQ(run("cut in.frames.jsonl --topic status --out a.jsonl"), 1);
  EXPECT_THAT(output(), HasSubstr("JSON lines have no topics"));
  const std::string whole = text("in.frames.jsonl");
  EXPECT_EQ(run("cut in.frames.jsonl --out in.frames.jsonl"), 1);
  EXPECT_EQ(text("in.frames.jsonl"), whole);
}

TEST_F(CutCommand, WhatIsNoLineIsLeftOutOrRefused) {
  std::ofstream(file("bad.jsonl")) << "nonsense\n" << text("in.frames.jsonl");
  EXPECT_TRUE(done("cut bad.jsonl --out a.jsonl"));
  EXPECT_THAT(output(), HasSubstr("left out: 1 x is not JSON (first: line 1)"));
  EXPECT_EQ(text("a.jsonl"), text("in.frames.jsonl"));
  EXPECT_EQ(run("cut --strict bad.jsonl --out a.jsonl"), 1);
  EXPECT_THAT(output(), HasSubstr("bad.jsonl:1: is not JSON"));
}

TEST_F(CutCommand, TheMissingEndOfARecordingIsLeftOutOrRefused) {
  ASSERT_TRUE(done("cut in.frames.jsonl --out in.mcap"));
  ASSERT_EQ(shell("head -c -40 in.mcap >short.mcap && head -c 100 in.mcap >shorter.mcap"), 0);
  EXPECT_TRUE(done("replay short.mcap"));
  EXPECT_THAT(output(), HasSubstr("short.mcap: left out: 1 x the recording is cut off"));
  EXPECT_EQ(run("replay shorter.mcap"), 1);
  EXPECT_THAT(output(), HasSubstr("nothing of it can be read: 1 x the recording is cut off"));
  for (const std::string command : {"replay", "cut --out a.mcap", "export --lanelet2 a.osm --in"}) {
    EXPECT_EQ(run(command + " short.mcap --strict"), 1) << command << output();
    EXPECT_THAT(output(), HasSubstr("short.mcap: at its end: the recording is cut off")) << command;
  }
}

/// The lines of a drive, of two sources by turns.
std::string of_two_sources(const std::string& lines) {
  std::istringstream in(lines);
  std::string out;
  for (std::string line; std::getline(in, line);)
    for (const char* source : {"front", "rear"}) {
      json frame = json::parse(line);
      frame["source"] = source;
      out += frame.dump() + "\n";
    }
  return out;
}

TEST_F(CutCommand, TwoSourcesMayHaveFramesAtOneStamp) {
  std::ofstream(file("two.frames.jsonl")) << of_two_sources(text("in.frames.jsonl"));
  ASSERT_TRUE(done("cut two.frames.jsonl --out two.mcap"));
  ASSERT_TRUE(done("cut two.mcap --out again.frames.jsonl"));
  EXPECT_EQ(lines_of(text("again.frames.jsonl")), lines_of(text("two.frames.jsonl")));
  EXPECT_TRUE(done("check two.frames.jsonl"));
}

TEST_F(CutCommand, FramesOutOfOrderAreToldAndLeftOut) {
  std::ofstream(file("twice.frames.jsonl")) << text("in.frames.jsonl") << text("in.frames.jsonl");
  const std::string command = "render --frames twice.frames.jsonl --at 1 --out a.svg";
  EXPECT_TRUE(done(command));
  EXPECT_THAT(output(),
              HasSubstr("left out: 80 x a frame is not later than one before it (first: stamp 0.1"));
  EXPECT_EQ(run(command + " --strict"), 1);
}

TEST_F(CutCommand, WhatExceedsAMessageIsLeftOutOrRefused) {
  const std::string whole = text("in.frames.jsonl");
  json frame = json::parse(whole.substr(0, whole.find('\n')));
  json& points = frame.at("detections").at(0).at("points");
  for (int i = 0; i < 3000; ++i) points.push_back({0.01 * i, 20.0, 0.0});
  std::ofstream(file("dense.frames.jsonl")) << frame << whole.substr(whole.find('\n'));
  for (const std::string command : {"cut", "import frames"}) {
    EXPECT_EQ(run(command + " dense.frames.jsonl --strict --out dense.mcap"), 1) << command;
    EXPECT_FALSE(exists("dense.mcap")) << command;
    EXPECT_TRUE(done(command + " dense.frames.jsonl --out dense.mcap"));
    EXPECT_THAT(output(), HasSubstr("1 x beyond the bounds of a message (first: stamp 0.100 s)")) << command;
    std::filesystem::remove(file("dense.mcap"));
  }
}

TEST_F(CutCommand, PosesMayBeInAFrameOfAnyName) {
  io::JsonLinesReader frames(file("in.frames.jsonl"));
  recording::RecordingWriter out(file("odom.mcap"), {.map_frame_id = "odom"});
  while (const auto record = frames.next_frame()) {
    out.write(record->pose, record->frame.stamp_ns);
    out.write(record->frame, record->frame.stamp_ns);
  }
  out.close();
  ASSERT_TRUE(done("cut odom.mcap --out a.frames.jsonl"));
  EXPECT_EQ(lines_of(text("a.frames.jsonl")), lines_of(text("in.frames.jsonl")));
  EXPECT_TRUE(done("import frames odom.mcap --out b.mcap"));
  EXPECT_TRUE(done("replay b.mcap"));
  EXPECT_EQ(info("odom.mcap").at("topics").size(), 2u);
}

TEST_F(CutCommand, NamesOfFilesControlNoTerminal) {
  std::ofstream(file("bad\x1b[31m.jsonl")) << "{}\n";
  EXPECT_EQ(run("replay 'bad\x1b[31m.jsonl' --strict"), 1);
  EXPECT_THAT(output(), HasSubstr("bad?[31m.jsonl"));
  EXPECT_THAT(output(), Not(HasSubstr("\x1b")));
}

TEST_F(CutCommand, APipeIsStandardInput) {
  for (const std::string command : {"replay", "cut --out a.jsonl", "evaluate --later --in"}) {
    EXPECT_EQ(run(command + " <(cat in.frames.jsonl)"), 1) << command;
    EXPECT_THAT(output(), HasSubstr("is a pipe; - stands for standard input")) << command;
  }
}

TEST_F(CutCommand, FilesOfAnotherKindAreNamed) {
  ASSERT_EQ(shell("gzip -k in.frames.jsonl truth.json"), 0);
  for (const std::string command : {"evaluate --truth truth.json --frames in.frames.jsonl.gz",
                                    "render --truth truth.json.gz --at 1 --out a.svg"}) {
    EXPECT_EQ(run(command), 1) << command;
    EXPECT_THAT(output(), HasSubstr("is compressed with gzip")) << command;
  }
}

TEST_F(CutCommand, CommandsAreJoinedByPipes) {
  ASSERT_EQ(shell("laneloom cut in.frames.jsonl --from 1 --out - | laneloom replay - --out - 2>report | "
                  "laneloom cut - --to 3 --out maps.jsonl"),
            0)
      << output() << text("report");
  EXPECT_EQ(lines_of(text("maps.jsonl")), 30u);
  EXPECT_THAT(text("report"), HasSubstr("hash")) << "the report went to standard error";
}

TEST_F(CutCommand, StandardOutputIsOneFileAtMost) {
  EXPECT_EQ(run("simulate --scenario straight --frames - --truth -"), 64);
  EXPECT_THAT(output(), HasSubstr("standard output is another file already"));
}

TEST_F(CutCommand, StrictCommandsFailAtTheFirstThingThatIsWrong) {
  ASSERT_TRUE(done("replay in.frames.jsonl --out maps.jsonl"));
  for (const std::string name : {"in.frames.jsonl", "maps.jsonl"}) {
    const std::string whole = text(name);
    std::ofstream(file("bad." + name)) << whole << "{\"t\": 9}\n";
  }
  for (const std::string command :
       {"evaluate --later --in bad.in.frames.jsonl",
        "evaluate --truth truth.json --frames bad.in.frames.jsonl",
        "evaluate --truth truth.json --map bad.maps.jsonl", "export bad.in.frames.jsonl --lanelet2 a.osm",
        "export bad.maps.jsonl --lanelet2 b.osm", "render --frames bad.in.frames.jsonl --at 1 --out a.svg",
        "render --map bad.maps.jsonl --at 1 --out b.svg", "learn bad.in.frames.jsonl --out profile.yaml"}) {
    EXPECT_TRUE(done(command));
    EXPECT_THAT(output(), HasSubstr("left out: 1 x ")) << command;
    EXPECT_EQ(run(command + " --strict"), 1) << command << output();
    EXPECT_THAT(output(), HasSubstr("jsonl:81: ")) << command;
    EXPECT_THAT(output(), Not(HasSubstr("\r"))) << "a bar is for terminals";
  }
}

}  // namespace
}  // namespace laneloom
