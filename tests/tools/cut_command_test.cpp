#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "io/json_lines.hpp"
#include "recording/recording.hpp"
#include "tools/commands.hpp"

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
    EXPECT_EQ(run({"info", "--json", file(name)}), 0) << output();
    return json::parse(output());
  }
};

TEST_F(CutCommand, LinesKeepTheirTextAndTheTimeIsHalfOpen) {
  const std::string whole = content(file("in.frames.jsonl"));
  ASSERT_EQ(run({"cut", file("in.frames.jsonl"), "--from", "2", "--to", "3.5", "--out", file("a.jsonl")}), 0)
      << output();
  const std::string part = content(file("a.jsonl"));
  EXPECT_EQ(lines_of(part), 15u);
  EXPECT_THAT(whole, HasSubstr(part));
  EXPECT_EQ(json::parse(part.substr(0, part.find('\n'))).at("stamp_ns"), 2'100'000'000)
      << "the first is at 0.1 s";
}

TEST_F(CutCommand, AllPartsTogetherAreTheDrive) {
  ASSERT_EQ(run({"cut", file("in.frames.jsonl"), "--to", "4", "--out", file("a.jsonl")}), 0) << output();
  ASSERT_EQ(run({"cut", file("in.frames.jsonl"), "--from", "4", "--out", file("b.jsonl")}), 0) << output();
  EXPECT_EQ(content(file("a.jsonl")) + content(file("b.jsonl")), content(file("in.frames.jsonl")));
}

TEST_F(CutCommand, OfARecordingTopicsAndTimeAreKeptWithTheConfiguration) {
  ASSERT_EQ(run({"replay", file("in.frames.jsonl"), "--out", file("maps.mcap")}), 0) << output();
  ASSERT_EQ(run({"cut", file("maps.mcap"), "--topic", "lane_map", "--to", "5", "--out", file("part.mcap")}),
            0)
      << output();
  const json whole = info("maps.mcap"), part = info("part.mcap");
  ASSERT_EQ(part.at("topics").size(), 1u);
  EXPECT_EQ(part.at("topics").begin()->at("messages"), 50);
  EXPECT_EQ(part.at("configuration"), whole.at("configuration"));
  EXPECT_NE(part.at("configuration"), "");
}

TEST_F(CutCommand, ObjectsOfOthersAreATopic) {
  ASSERT_EQ(run({"simulate", "--scenario", "town", "--traffic", "usual", "--duration", "2", "--frames",
                 file("t.frames.jsonl")}),
            0);
  ASSERT_EQ(run({"cut", file("t.frames.jsonl"), "--out", file("t.mcap")}), 0) << output();
  ASSERT_EQ(run({"cut", file("t.mcap"), "--topic", "objects", "--out", file("objects.mcap")}), 0) << output();
  EXPECT_THAT(output(), HasSubstr("20 messages"));
}

TEST_F(CutCommand, ObjectsOfARecordingAreInItsLines) {
  ASSERT_EQ(run({"simulate", "--scenario", "town", "--traffic", "usual", "--duration", "2", "--frames",
                 file("t.frames.jsonl")}),
            0);
  ASSERT_EQ(run({"cut", file("t.frames.jsonl"), "--out", file("t.mcap")}), 0) << output();
  ASSERT_EQ(run({"cut", file("t.mcap"), "--out", file("back.frames.jsonl")}), 0) << output();
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

TEST_F(CutCommand, ObjectsBetweenFramesGoOnToTheNextOne) {
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
    for (const int i : {2, 3})
      writer.write(DetectionFrame{.stamp_ns = at(i), .sequence = static_cast<std::uint64_t>(i)}, at(4));
    writer.close();
  }
  ASSERT_EQ(run({"cut", file("drive.mcap"), "--out", file("drive.frames.jsonl")}), 0) << output();
  io::JsonLinesReader lines(file("drive.frames.jsonl"));
  const auto first = lines.next_frame(), second = lines.next_frame();
  ASSERT_TRUE(first && second && first->objects);
  ASSERT_EQ(first->objects->objects.size(), 1u) << "the newest alone";
  EXPECT_TRUE(first->objects->objects[0].position.isApprox(Point(31, 2, 0)))
      << "by 2 m, and the vehicle by 1 m";
  EXPECT_FALSE(second->objects) << "each is told once";
}

TEST_F(CutCommand, ARecordingBecomesLinesAndLinesARecording) {
  ASSERT_EQ(run({"cut", file("in.frames.jsonl"), "--out", file("drive.mcap")}), 0) << output();
  ASSERT_EQ(run({"cut", file("drive.mcap"), "--out", file("back.frames.jsonl")}), 0) << output();
  ASSERT_EQ(run({"replay", file("in.frames.jsonl"), "--report", file("a.json")}), 0) << output();
  ASSERT_EQ(run({"replay", file("back.frames.jsonl"), "--report", file("b.json")}), 0) << output();
  EXPECT_EQ(json::parse(content(file("a.json"))).at("frames"),
            json::parse(content(file("b.json"))).at("frames"));
  EXPECT_EQ(lines_of(content(file("back.frames.jsonl"))), 80u);

  ASSERT_EQ(run({"replay", file("in.frames.jsonl"), "--out", file("maps.mcap")}), 0) << output();
  ASSERT_EQ(run({"cut", file("maps.mcap"), "--topic", "lane_map", "--out", file("maps.jsonl")}), 0)
      << output();
  EXPECT_THAT(content(file("maps.jsonl")), HasSubstr("\"lanes\""));
}

TEST_F(CutCommand, APartWithNothingInItIsAnError) {
  EXPECT_EQ(run({"cut", file("in.frames.jsonl"), "--from", "100", "--out", file("a.jsonl")}), 1);
  EXPECT_THAT(output(), HasSubstr("nothing of it is in that part"));
  EXPECT_EQ(run({"cut", file("in.frames.jsonl"), "--from", "3", "--to", "2", "--out", file("a.jsonl")}), 64);
  EXPECT_EQ(run({"cut", file("in.frames.jsonl"), "--topic", "status", "--out", file("a.jsonl")}), 1);
  EXPECT_THAT(output(), HasSubstr("JSON lines have no topics"));
  const std::string whole = content(file("in.frames.jsonl"));
  EXPECT_EQ(run({"cut", file("in.frames.jsonl"), "--out", file("in.frames.jsonl")}), 1);
  EXPECT_EQ(content(file("in.frames.jsonl")), whole);
}

TEST_F(CutCommand, WhatIsNoLineIsLeftOutOrRefused) {
  std::ofstream(file("bad.jsonl")) << "nonsense\n" << content(file("in.frames.jsonl"));
  EXPECT_EQ(run({"cut", file("bad.jsonl"), "--out", file("a.jsonl")}), 0);
  EXPECT_THAT(output(), HasSubstr("left out: 1 x is not JSON (first: line 1)"));
  EXPECT_EQ(content(file("a.jsonl")), content(file("in.frames.jsonl")));
  EXPECT_EQ(run({"cut", "--strict", file("bad.jsonl"), "--out", file("a.jsonl")}), 1);
  EXPECT_THAT(output(), HasSubstr("bad.jsonl:1: is not JSON"));
}

TEST_F(CutCommand, CommandsAreJoinedByPipes) {
  const std::string command = LANELOOM_COMMAND;
  const std::string chain = command + " cut " + file("in.frames.jsonl") + " --from 1 --out - | " + command +
                            " replay - --out - 2>" + file("report") + " | " + command +
                            " cut - --to 3 --out " + file("maps.jsonl");
  ASSERT_EQ(support::ChildProcess({"/bin/bash", "-o", "pipefail", "-c", chain}, file("output")).wait(), 0)
      << output() << content(file("report"));
  EXPECT_EQ(lines_of(content(file("maps.jsonl"))), 30u);
  EXPECT_THAT(content(file("report")), HasSubstr("hash")) << "the report went to standard error";
}

TEST_F(CutCommand, StandardOutputIsOneFileAtMost) {
  EXPECT_EQ(run({"simulate", "--scenario", "straight", "--frames", "-", "--truth", "-"}), 64);
  EXPECT_THAT(output(), HasSubstr("standard output is another file already"));
}

TEST_F(CutCommand, StrictCommandsFailAtTheFirstThingThatIsWrong) {
  ASSERT_EQ(run({"replay", file("in.frames.jsonl"), "--out", file("maps.jsonl")}), 0) << output();
  for (const std::string name : {"in.frames.jsonl", "maps.jsonl"}) {
    const std::string whole = content(file(name));
    std::ofstream(file("bad." + name)) << whole << "{\"t\": 9}\n";
  }
  const std::vector<std::vector<std::string>> commands{
      {"evaluate", "--later", "--in", file("bad.in.frames.jsonl")},
      {"evaluate", "--truth", file("truth.json"), "--frames", file("bad.in.frames.jsonl")},
      {"evaluate", "--truth", file("truth.json"), "--map", file("bad.maps.jsonl")},
      {"export", file("bad.in.frames.jsonl"), "--lanelet2", file("a.osm")},
      {"export", file("bad.maps.jsonl"), "--lanelet2", file("b.osm")},
      {"render", "--frames", file("bad.in.frames.jsonl"), "--at", "1", "--out", file("a.svg")},
      {"render", "--map", file("bad.maps.jsonl"), "--at", "1", "--out", file("b.svg")},
      {"learn", file("bad.in.frames.jsonl"), "--out", file("profile.yaml")}};
  for (std::vector<std::string> command : commands) {
    EXPECT_EQ(run(command), 0) << command[0] << output();
    EXPECT_THAT(output(), HasSubstr("left out: 1 x ")) << command[0];
    command.emplace_back("--strict");
    EXPECT_EQ(run(command), 1) << command[0] << output();
    EXPECT_THAT(output(), HasSubstr("jsonl:81: ")) << command[0];
    EXPECT_THAT(output(), Not(HasSubstr("\r"))) << "a bar is for terminals";
  }
}

}  // namespace
}  // namespace laneloom
