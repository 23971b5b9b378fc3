#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "commands.hpp"
#include "io/feather_writer.hpp"
#include "io/json_lines.hpp"
#include "recording/recording.hpp"

// The commands that read and write files, as processes.
namespace laneloom {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A map of Argoverse 2 with one lane.
constexpr const char* kOneLaneMap =
    R"({"drivable_areas":{},"lane_segments":{"7":{"id":7,"is_intersection":false,"lane_type":"VEHICLE",)"
    R"("successors":[],"left_lane_mark_type":"DASHED_WHITE","right_lane_mark_type":"SOLID_WHITE",)"
    R"("left_lane_boundary":[{"x":0,"y":2,"z":0},{"x":50,"y":2,"z":0}],)"
    R"("right_lane_boundary":[{"x":0,"y":-2,"z":0},{"x":50,"y":-2,"z":0}]}}})";

/// Frames and their poses as they would have been recorded.
void record(const std::string& frames, const std::string& recording) {
  recording::RecordingWriter out(recording);
  io::JsonLinesReader in(frames);
  while (const auto record = in.next_frame()) {
    out.write(record->pose, record->pose.stamp_ns);
    out.write(record->frame, record->frame.stamp_ns);
  }
  out.close();
}

TEST_F(Commands, DetectionsWithoutNoiseScorePerfectly) {
  simulate("none", "in.frames.jsonl");
  ASSERT_TRUE(done("evaluate --truth truth.json --frames in.frames.jsonl --json score.json"));
  const json score = json_of("score.json").at("raw");
  EXPECT_EQ(score.at("frames"), 80);
  EXPECT_GT(score.at("total").at("truth"), 80);
  EXPECT_EQ(score.at("total").at("precision"), 1.0);
  EXPECT_EQ(score.at("total").at("recall"), 1.0);
  EXPECT_LT(score.at("total").at("acd_m"), 0.02);
}

TEST_F(Commands, EveryLogInADirectoryIsSimulated) {
  for (const std::string log : {"log_a", "log_b"}) {
    std::filesystem::create_directories(file("data/val/" + log + "/map"));
    write_bytes(file("data/val/" + log + "/city_SE3_egovehicle.feather"),
                FeatherWriter(pose_columns(1'000'000'000, 11)).write());
    std::ofstream(file("data/val/" + log + "/map/log_map_archive_x.json")) << kOneLaneMap;
  }
  ASSERT_TRUE(done("simulate --argoverse2 data --frames frames --truth truth"));
  for (const std::string log : {"log_a", "log_b"}) {
    EXPECT_GT(text("frames/" + log + ".frames.jsonl").size(), 100u);
    EXPECT_THAT(text("truth/" + log + ".truth.json"), HasSubstr(log));
  }
  EXPECT_EQ(run("publish --argoverse2 data --duration 1"), 1);
  EXPECT_THAT(output(), HasSubstr("holds 2 logs; name one"));
}

TEST_F(Commands, TheTrafficOfALogIsSimulatedAsItWasRecorded) {
  std::filesystem::create_directories(file("log"));
  write_bytes(file("log/city_SE3_egovehicle.feather"),
              FeatherWriter(pose_columns(1'000'000'000, 11)).write());
  std::ofstream(file("log/log_map_archive_x.json")) << kOneLaneMap;
  const std::string recorded = "simulate --argoverse2 log --traffic recorded --frames a.jsonl";
  ASSERT_TRUE(done(recorded));
  EXPECT_FALSE(io::JsonLinesReader(file("a.jsonl")).next_frame()->objects) << "it has no annotations";

  std::vector<AnnotationRow> rows;
  for (const int sweep : {4, 5, 6})
    rows.push_back({1'000'000'000 + sweep * 100'000'000 - 30'000'000, "a", "TRUCK", 20.0});
  write_bytes(file("log/annotations.feather"), FeatherWriter(annotation_columns(rows)).write());
  ASSERT_TRUE(done(recorded));
  io::JsonLinesReader frames(file("a.jsonl"));
  std::vector<std::size_t> counts;
  while (const auto record = frames.next_frame()) {
    ASSERT_TRUE(record->objects);
    counts.push_back(record->objects->objects.size());
    for (const TrackedObject& truck : record->objects->objects) {
      EXPECT_EQ(truck.kind, ObjectKind::truck);
      EXPECT_NEAR(truck.position.x(), 20.0, 1e-6) << "it drives ahead as fast as the vehicle";
    }
  }
  EXPECT_EQ(counts, (std::vector<std::size_t>{0, 0, 0, 1, 1, 1, 1, 0, 0, 0}));

  EXPECT_EQ(run("simulate --scenario straight --traffic recorded --frames b"), 1);
  EXPECT_THAT(output(), HasSubstr("only a log (--argoverse2) has recorded traffic"));
}

TEST_F(Commands, FusedMapsAreEvaluatedAtTheStampsThatDetectionsHaveToo) {
  simulate("none", "in.frames.jsonl");
  ASSERT_TRUE(done("replay --in in.frames.jsonl --out map.jsonl"));
  std::string shorter = text("map.jsonl");
  shorter.erase(0, shorter.find('\n') + 1);
  std::ofstream(file("shorter.jsonl")) << shorter;
  ASSERT_TRUE(
      done("evaluate --truth truth.json --frames in.frames.jsonl --map shorter.jsonl --json score.json"));
  const json score = json_of("score.json");
  EXPECT_EQ(score.at("raw").at("frames"), 79);
  EXPECT_EQ(score.at("fused").at("frames"), 79);
  EXPECT_GT(score.at("fused").at("lane").at("matched"), 0);
}

TEST_F(Commands, RenderDrawsEveryInput) {
  simulate("none", "in.frames.jsonl");
  ASSERT_TRUE(done("replay --in in.frames.jsonl --out map.jsonl"));
  ASSERT_TRUE(
      done("render --truth truth.json --frames in.frames.jsonl --map map.jsonl --sequence 2 --out map.png"));
  EXPECT_EQ(text("map.png").substr(1, 3), "PNG");
  ASSERT_TRUE(done("render --truth truth.json --at 3 --out truth.svg"));
  EXPECT_THAT(text("truth.svg"), HasSubstr("</svg>"));
  EXPECT_EQ(run("render --truth truth.json --at 3 --out truth.bmp"), 64);
  EXPECT_THAT(output(), HasSubstr("pictures are .png or .svg"));
}

TEST_F(Commands, MapsOfAnotherDriveAreNoMapsOfTheFrames) {
  simulate("none", "in.frames.jsonl");
  ASSERT_TRUE(done("simulate --scenario town --duration 8 --seed 3 --frames other.frames.jsonl"));
  ASSERT_TRUE(done("replay --in other.frames.jsonl --out other.jsonl"));
  for (const std::string command : {"render --out a.svg --at 3", "evaluate --later"}) {
    EXPECT_EQ(run(command + " --frames in.frames.jsonl --map other.jsonl"), 1);
    EXPECT_THAT(output(), HasSubstr("are of two drives")) << command;
  }
}

TEST_F(Commands, RenderWritesNoPictureOverAnInputOrLargerThanPicturesAre) {
  simulate("none", "in.frames.jsonl");
  const std::string truth = text("truth.json");
  std::filesystem::create_symlink("truth.json", file("truth.svg"));
  EXPECT_EQ(run("render --truth truth.json --out truth.svg"), 1);
  EXPECT_THAT(output(), HasSubstr("is an input"));
  EXPECT_EQ(text("truth.json"), truth);
  EXPECT_EQ(run("render --truth truth.json --sequence 50 --out large.png"), 1);
  EXPECT_THAT(output(), HasSubstr("draw fewer moments, a smaller range, or an .svg"));
  EXPECT_TRUE(done("render --truth truth.json --sequence 50 --out large.svg"));
}

TEST_F(Commands, EveryCommandTakesRecordingsAndLines) {
  simulate("none", "in.frames.jsonl");
  ASSERT_TRUE(done("replay --in in.frames.jsonl --out map.jsonl"));
  ASSERT_TRUE(done("replay --in in.frames.jsonl --out map.mcap"));
  record(file("in.frames.jsonl"), file("in.mcap"));
  std::vector<std::string> pictures;
  for (const std::string frames : {"in.frames.jsonl", "in.mcap"}) {
    for (const std::string map : {"map.jsonl", "map.mcap"}) {
      ASSERT_TRUE(done("render --frames " + frames + " --map " + map + " --at 3 --out x.svg"));
      pictures.push_back(text("x.svg"));
      ASSERT_TRUE(done("evaluate --truth truth.json --frames " + frames + " --map " + map));
    }
    ASSERT_TRUE(done("replay --in " + frames));
  }
  EXPECT_THAT(pictures, testing::Each(pictures.front()));
}

TEST_F(Commands, NarrowLanesThatTheConfigurationFindsAreRated) {
  const std::string lane =
      R"(type="driving"><width sOffset="0" a="1.5"/><roadMark sOffset="0" type="solid"/></lane>)";
  std::ofstream(file("yard.xodr"))
      << R"(<OpenDRIVE><road id="1"><planView><geometry s="0" x="0" y="0" hdg="0" length="80">)"
      << R"(<line/></geometry></planView><lanes><laneSection s="0"><center><lane id="0">)"
      << R"(<roadMark sOffset="0" type="solid"/></lane></center><right><lane id="-1" )" << lane
      << R"(<lane id="-2" )" << lane << "</right></laneSection></lanes></road></OpenDRIVE>";
  std::ofstream(file("yard.yaml")) << "mapper: {lane: {min_width_m: 1.2, assumed_width_m: 1.5}}";
  ASSERT_TRUE(done("simulate --opendrive yard.xodr --speed 8 --frames in.frames.jsonl --truth truth.json"));
  const auto rate = [&](const std::string& options) {
    EXPECT_TRUE(done("replay in.frames.jsonl --out map.jsonl " + options));
    EXPECT_TRUE(done("evaluate --truth truth.json --map map.jsonl --json -"));
    return json::parse(output().substr(output().find("\n{\n"))).at("fused").at("lane");
  };
  const json narrow = rate("--config yard.yaml");
  EXPECT_GT(narrow.at("recall"), 0.9);
  EXPECT_GT(narrow.at("precision"), 0.9);
  EXPECT_EQ(rate("").at("matched"), 0) << "lanes are wider by default";
  ASSERT_TRUE(done("evaluate --later in.frames.jsonl --config yard.yaml"));
  EXPECT_THAT(output(), HasSubstr("own lane in 100.0 % of the frames, width 5/50/95 % 1.50/1.50/1.50 m"));
}

TEST_F(Commands, ADriveIsMappedAndRatedByItsTruthAtOnce) {
  ASSERT_TRUE(done(
      "simulate --scenario split --noise inhouse --duration 6 --frames a.frames.jsonl --truth truth.json"));
  ASSERT_TRUE(done("replay a.frames.jsonl --out map.jsonl"));
  const auto figures = [&](const std::string& inputs) {
    EXPECT_TRUE(done("evaluate --truth truth.json --json figures.json " + inputs));
    return json_of("figures.json");
  };
  const json at_once = figures("a.frames.jsonl");
  EXPECT_EQ(at_once, figures("--frames a.frames.jsonl --map map.jsonl"));
  EXPECT_GT(at_once.at("fused").at("total").at("f1"), 0.5);
}

TEST_F(Commands, PublishListsItsRoads) {
  EXPECT_TRUE(done("publish --list"));
  EXPECT_THAT(output(), HasSubstr("town"));
}

}  // namespace
}  // namespace laneloom
