#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "commands.hpp"
#include "recording/recording.hpp"

// `laneloom replay`, as a process.
namespace laneloom {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST_F(Commands, ReplayGivesTheSameMapsAgain) {
  simulate("inhouse", "in.frames.jsonl");
  for (const std::string out : {"a.jsonl", "b.jsonl"})
    ASSERT_TRUE(done("replay --in in.frames.jsonl --out " + out + " --preset av2 --report report.json"));
  EXPECT_GT(text("a.jsonl").size(), 10'000u);
  EXPECT_EQ(text("a.jsonl"), text("b.jsonl"));
  const json report = json_of("report.json");
  EXPECT_EQ(report.at("frames"), 80);
  EXPECT_GT(report.at("ms").at("total").at("mean"), 0.0);
  EXPECT_TRUE(report.at("ms").contains("association"));
  EXPECT_FALSE(report.at("ms").contains("clustering"));

  // Nor does the mathematical library's variant change them, which the processor selects.
  setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-AVX2_Usable,-FMA,-FMA_Usable,-FMA4,-ERMS", 1);
  ASSERT_TRUE(done("replay --in in.frames.jsonl --preset av2"));
  unsetenv("GLIBC_TUNABLES");
  EXPECT_THAT(output(), HasSubstr(report.at("hash")));
}

TEST_F(Commands, LearnWritesAProfileThatAReplayStartsWith) {
  simulate("inhouse", "in.frames.jsonl");
  ASSERT_TRUE(done("learn --in in.frames.jsonl --out network.yaml"));
  EXPECT_THAT(output(), HasSubstr("lateral standard deviation"));
  const auto replay = [&](const std::string& fusion) {
    std::ofstream(file("c.yaml")) << "mapper: {fusion: {" << fusion << "}}";
    EXPECT_TRUE(done("replay --in in.frames.jsonl --config c.yaml --report r.json"));
    return json_of("r.json").at("hash");
  };
  const json nothing = replay("");
  EXPECT_NE(replay("profile_file: '" + file("network.yaml") + "'"), nothing);
  EXPECT_EQ(replay("profile_file: ''"), nothing);

  std::ofstream(file("network.yaml")) << "front: {stddev: {value: 1, weight: 1}}";
  EXPECT_TRUE(done("replay --in in.frames.jsonl --config c.yaml"));
  std::ofstream(file("c.yaml")) << "mapper: {fusion: {profile_file: '" << file("network.yaml") << "'}}";
  EXPECT_EQ(run("replay --in in.frames.jsonl --config c.yaml"), 1);
  EXPECT_THAT(output(), HasSubstr("network.yaml: front.stddev is not a value that is learned of a network"));
  std::ofstream(file("network.yaml")) << "rear: {confidence: {value: 0.7, weight: 100}}";
  EXPECT_TRUE(done("replay --in in.frames.jsonl --config c.yaml"));
  EXPECT_THAT(output(), HasSubstr("the profile of the source \"rear\" is not used"));
}

TEST_F(Commands, ReplayWritesRecordingsToo) {
  simulate("inhouse", "in.frames.jsonl");
  ASSERT_TRUE(done("replay --in in.frames.jsonl --out maps.mcap"));
  recording::RecordingReader reader(file("maps.mcap"));
  std::size_t maps = 0, markings = 0;
  while (const auto message = reader.next()) {
    maps += std::holds_alternative<PublishedMap>(message->message) ? 1U : 0U;
    markings += std::holds_alternative<RoadMarkings>(message->message) ? 1U : 0U;
  }
  EXPECT_EQ(maps, 80U);
  EXPECT_EQ(markings, 80U);
}

TEST_F(Commands, ReplayComparesConfigurations) {
  simulate("inhouse", "in.frames.jsonl");
  ASSERT_TRUE(
      done("replay in.frames.jsonl --config $CONFIG/laneloom.yaml --config $CONFIG/paper.yaml "
           "--config $CONFIG/laneloom.yaml --truth truth.json --report report.json"));
  EXPECT_THAT(output(), HasSubstr("others"));
  EXPECT_THAT(output(), HasSubstr("the same"));
  const json results = json_of("report.json").at("configurations");
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[0].at("hash"), results[2].at("hash"));
  EXPECT_NE(results[0].at("hash"), results[1].at("hash"));
  EXPECT_NE(run("replay in.frames.jsonl --config $CONFIG/laneloom.yaml --out a --out b"), 0);
}

TEST_F(Commands, ReplayWritesNothingOverItsInputOrAnotherOutput) {
  simulate("none", "in.frames.jsonl");
  std::filesystem::create_symlink(file("in.frames.jsonl"), file("link.jsonl"));
  const std::string before = text("in.frames.jsonl");
  for (const std::string out : {"in.frames.jsonl", "link.jsonl", "./in.frames.jsonl"}) {
    for (const std::string option : {"--out", "--report"}) {
      EXPECT_EQ(run("replay --in in.frames.jsonl " + option + " " + out), 1) << out;
      EXPECT_THAT(output(), HasSubstr(out + ": is an input"));
    }
  }
  EXPECT_EQ(run("replay --in in.frames.jsonl --truth truth.json --out truth.json"), 1);
  EXPECT_EQ(text("in.frames.jsonl"), before);

  const std::string configs = "--config $CONFIG/laneloom.yaml --config $CONFIG/laneloom.yaml ";
  EXPECT_EQ(run("replay in.frames.jsonl " + configs + "--out a.jsonl --out ./a.jsonl"), 1);
  EXPECT_THAT(output(), HasSubstr("twice"));
  EXPECT_FALSE(exists("a.jsonl"));
}

TEST_F(Commands, ReplayRefusesOptionsThatWouldBeOfNoAccount) {
  simulate("none", "in.frames.jsonl");
  for (const std::string option :
       {"--verify", "--out a", "--config $CONFIG/laneloom.yaml", "--truth truth.json", "--report r.json",
        "--range -5,30,-15,15", "--preset av2"}) {
    EXPECT_GT(run("replay in.frames.jsonl --publish --speed-up 100 " + option), 1) << option;
    EXPECT_THAT(output(), HasSubstr(option.substr(0, option.find(' '))));
  }
  for (const std::string option : {"--verify", "--out a", "--truth truth.json", "--report r.json", "--strict",
                                   "--config $CONFIG/laneloom.yaml --config $CONFIG/paper.yaml"}) {
    EXPECT_EQ(run("replay in.frames.jsonl --explain 3@5 " + option), 64) << option;
    EXPECT_THAT(output(), HasSubstr(option.substr(0, option.find(' '))));
  }
  for (const std::string asked : {"3", "3@", "x@5"}) {
    EXPECT_EQ(run("replay in.frames.jsonl --explain " + asked), 64);
    EXPECT_THAT(output(), HasSubstr("must be ID@TIME"));
  }
  EXPECT_EQ(run("replay in.frames.jsonl --explain d900@5"), 1);
  EXPECT_THAT(output(), HasSubstr("the frame has no detection of the number 900"));
  EXPECT_GT(run("replay --in in.frames.jsonl --domain 7"), 1);
  EXPECT_GT(run("replay --in in.frames.jsonl --compression lz4"), 1);
}

TEST_F(Commands, AReplayThatGivesNothingSaysWhy) {
  std::ofstream(file("near.yaml")) << "gate: {max_coordinate_m: 1000}";
  const auto advice = [&](const std::string& lines, const std::string& options = "") {
    std::ofstream(file("in.jsonl")) << lines;
    const int code = run("replay --in in.jsonl --out maps.mcap" + options);
    const bool in_vain = output().find("no map came of it") != std::string::npos;
    EXPECT_EQ(code, in_vain ? 1 : 0);
    EXPECT_EQ(exists("maps.mcap"), !in_vain);
    std::filesystem::remove(file("maps.mcap"));
    return output();
  };
  /// Frames every 2 m, each with a line that no vehicle drives along.
  const auto drive = [](int frames, double confidence) {
    std::string lines;
    for (int i = 0; i < frames; ++i)
      lines += R"({"t":)" + std::to_string(0.1 * i) + R"(,"pose":[)" + std::to_string(2 * i) +
               R"(,0,0,0,0,0,1],"detections":[{"type":"laneline","style":"solid","score":)" +
               std::to_string(confidence) + R"(,"points":[[0,9,0],[10,9,0],[25,9,0]]}]})" + "\n";
    return lines;
  };
  EXPECT_THAT(advice("\n"), HasSubstr("no map came of it: the input has no detections"));
  std::ofstream(file("empty.jsonl")).close();
  EXPECT_EQ(run("replay --in empty.jsonl"), 1);
  EXPECT_THAT(output(), HasSubstr("is empty; a recording (MCAP) or frames"));
  EXPECT_THAT(advice(R"({"t":1,"pose":[2000,0,0,0,0,0,1],"detections":[]})", " --config near.yaml"),
              HasSubstr("all poses were refused, most of them as 'coordinate'"));
  EXPECT_THAT(advice(R"({"t":1,"pose":[0,0,0,0,0,0,1],"detections":[]})"),
              HasSubstr("no map has a marking: no frame has a detection"));
  EXPECT_THAT(advice(drive(20, 0.1)), HasSubstr("confidence of 0.3 or more"));
  EXPECT_THAT(advice(drive(3, 0.9)), HasSubstr("3 frames were fused, and a lane needs about 5"));
  EXPECT_THAT(advice(drive(20, 0.9)),
              HasSubstr("no map has a lane: a lane needs a line or an edge on both sides"));
  simulate("none", "good.jsonl");
  EXPECT_TRUE(done("replay --in good.jsonl"));
  EXPECT_THAT(output(), testing::Not(HasSubstr("no map")));
  EXPECT_THAT(output(), testing::Not(HasSubstr("refused as")));
  std::istringstream good(text("good.jsonl"));
  std::ofstream leaving(file("leaving.jsonl"));
  for (std::string line; std::getline(good, line);) {
    json frame = json::parse(line);
    frame["pose"][0] = 970.0 + frame["pose"][0].get<double>();
    leaving << frame << "\n";
  }
  leaving.close();
  EXPECT_TRUE(done("replay --in leaving.jsonl --config near.yaml"));
  EXPECT_THAT(output(), HasSubstr("poses were refused as 'coordinate'"));
}

TEST_F(Commands, AReplayTellsOfObjectsThatAreOfNoUse) {
  simulate("none", "good.jsonl");
  const auto advice = [&](const json& objects) {
    std::istringstream good(text("good.jsonl"));
    std::ofstream in(file("in.jsonl"));
    for (std::string line; std::getline(good, line);) {
      json frame = json::parse(line);
      frame["objects"] = objects;
      in << frame << "\n";
    }
    in.close();
    EXPECT_TRUE(done("replay --in in.jsonl"));
    return output();
  };
  json car{{"id", 3}, {"kind", "car"}, {"position", {20, 3, 0}}, {"heading", {1, 0, 0}}, {"speed", 9}};
  EXPECT_THAT(advice(json::array({car})), testing::Not(HasSubstr("objects")));
  EXPECT_THAT(advice(json::array({car, car})),
              HasSubstr("messages of objects were refused as 'repeated_id'"));
  car.erase("heading");
  EXPECT_THAT(advice(json::array({car})), HasSubstr("moving objects none left a trail"));
}

TEST_F(Commands, ADriveThatBeginsAtTimeZeroLosesNoFrame) {
  simulate("none", "in.frames.jsonl");
  std::ifstream in(file("in.frames.jsonl"));
  std::ofstream out(file("zero.jsonl"));
  std::int64_t t_ns = 0;
  for (std::string line; std::getline(in, line); t_ns += 100'000'000) {
    json frame = json::parse(line);
    frame["t"] = static_cast<double>(t_ns) * 1e-9;
    frame.erase("stamp_ns");
    out << frame.dump() << '\n';
  }
  out.close();
  ASSERT_TRUE(done("replay --in zero.jsonl --report report.json"));
  EXPECT_EQ(json_of("report.json").at("frames"), 80);
  EXPECT_THAT(output(), testing::Not(HasSubstr("refused")));
}

TEST_F(Commands, ReplayOfADriveThatBeginsAgainClearsTheMap) {
  simulate("none", "in.frames.jsonl");
  const std::string frames = text("in.frames.jsonl");
  std::ofstream(file("twice.frames.jsonl")) << frames << frames;
  ASSERT_TRUE(done("replay --in twice.frames.jsonl --report report.json"));
  EXPECT_THAT(output(), HasSubstr("map_resets "));
  const json counters = json_of("report.json").at("counters");
  std::uint64_t frames_seen = 0;
  for (const auto& [name, count] : counters.items()) {
    if (name == "frames_fused" || name.starts_with("detections_refused"))
      frames_seen += count.get<std::uint64_t>();
  }
  EXPECT_EQ(frames_seen, 160U);
}

}  // namespace
}  // namespace laneloom
