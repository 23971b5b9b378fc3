#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "recording/recording.hpp"
#include "tools/commands.hpp"

// `laneloom replay`, as a process.
namespace laneloom {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST_F(Commands, ReplayGivesTheSameMapsAgain) {
  simulate("inhouse", "in.frames.jsonl");
  for (const char* out : {"a.jsonl", "b.jsonl"})
    ASSERT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--out", file(out), "--preset", "av2",
                   "--report", file("report.json")}),
              0)
        << output();
  EXPECT_GT(content(file("a.jsonl")).size(), 10'000u);
  EXPECT_EQ(content(file("a.jsonl")), content(file("b.jsonl")));
  const json report = json::parse(content(file("report.json")));
  EXPECT_EQ(report.at("frames"), 80);
  EXPECT_GT(report.at("ms").at("total").at("mean"), 0.0);
  EXPECT_TRUE(report.at("ms").contains("association"));
  EXPECT_FALSE(report.at("ms").contains("clustering"));

  // Nor does the mathematical library's variant change them, which the processor selects.
  setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-AVX2_Usable,-FMA,-FMA_Usable,-FMA4,-ERMS", 1);
  ASSERT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--preset", "av2"}), 0) << output();
  unsetenv("GLIBC_TUNABLES");
  EXPECT_THAT(output(), HasSubstr(report.at("hash")));
}

TEST_F(Commands, LearnWritesAProfileThatAReplayStartsWith) {
  simulate("inhouse", "in.frames.jsonl");
  ASSERT_EQ(run({"learn", "--in", file("in.frames.jsonl"), "--out", file("network.yaml")}), 0) << output();
  EXPECT_THAT(output(), HasSubstr("lateral standard deviation"));
  const auto replay = [&](const std::string& fusion, const char* report) {
    std::ofstream(file("c.yaml")) << "mapper: {fusion: {" << fusion << "}}";
    EXPECT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--config", file("c.yaml"), "--report",
                   file(report)}),
              0)
        << output();
    return json::parse(content(file(report))).at("hash");
  };
  const json nothing = replay("", "r.json");
  EXPECT_NE(replay("profile_file: '" + file("network.yaml") + "'", "r.json"), nothing);
  EXPECT_EQ(replay("profile_file: ''", "r.json"), nothing);

  std::ofstream(file("network.yaml")) << "front: {stddev: {value: 1, weight: 1}}";
  EXPECT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--config", file("c.yaml")}), 0);
  std::ofstream(file("c.yaml")) << "mapper: {fusion: {profile_file: '" << file("network.yaml") << "'}}";
  EXPECT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--config", file("c.yaml")}), 1);
  EXPECT_THAT(output(), HasSubstr("network.yaml: front.stddev is not a value that is learned of a network"));
}

TEST_F(Commands, ReplayWritesRecordingsToo) {
  simulate("inhouse", "in.frames.jsonl");
  ASSERT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--out", file("maps.mcap")}), 0) << output();
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
  ASSERT_EQ(
      run({"replay", "--in", file("in.frames.jsonl"), "--config", LANELOOM_CONFIG_DIR "/laneloom.yaml",
           "--config", LANELOOM_CONFIG_DIR "/paper.yaml", "--config", LANELOOM_CONFIG_DIR "/laneloom.yaml",
           "--truth", file("truth.json"), "--report", file("report.json")}),
      0)
      << output();
  EXPECT_THAT(output(), HasSubstr("others"));
  EXPECT_THAT(output(), HasSubstr("the same"));
  const json results = json::parse(content(file("report.json"))).at("configurations");
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[0].at("hash"), results[2].at("hash"));
  EXPECT_NE(results[0].at("hash"), results[1].at("hash"));
  EXPECT_NE(run({"replay", "--in", file("in.frames.jsonl"), "--config", LANELOOM_CONFIG_DIR "/laneloom.yaml",
                 "--out", file("a"), "--out", file("b")}),
            0);
}

TEST_F(Commands, ReplayWritesNothingOverItsInputOrAnotherOutput) {
  simulate("none", "in.frames.jsonl");
  std::filesystem::create_symlink(file("in.frames.jsonl"), file("link.jsonl"));
  const std::string before = content(file("in.frames.jsonl"));
  for (const std::string out : {"in.frames.jsonl", "link.jsonl", "./in.frames.jsonl"}) {
    for (const char* option : {"--out", "--report"}) {
      EXPECT_EQ(run({"replay", "--in", file("in.frames.jsonl"), option, file(out)}), 1) << out;
      EXPECT_THAT(output(), HasSubstr(out + ": is the input"));
    }
  }
  EXPECT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--truth", file("truth.json"), "--out",
                 file("truth.json")}),
            1);
  EXPECT_EQ(content(file("in.frames.jsonl")), before);

  const std::string config = LANELOOM_CONFIG_DIR "/laneloom.yaml";
  EXPECT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--config", config, "--config", config, "--out",
                 file("a.jsonl"), "--out", file("./a.jsonl")}),
            1);
  EXPECT_THAT(output(), HasSubstr("twice"));
  EXPECT_FALSE(std::filesystem::exists(file("a.jsonl")));
}

TEST_F(Commands, ReplayRefusesOptionsThatWouldBeOfNoAccount) {
  simulate("none", "in.frames.jsonl");
  const auto replay = [&](std::vector<std::string> words) {
    words.insert(words.begin(),
                 {"replay", "--in", file("in.frames.jsonl"), "--publish", "--speed-up", "100"});
    return run(words);
  };
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--verify"},
                                                {"--out", file("a")},
                                                {"--config", LANELOOM_CONFIG_DIR "/laneloom.yaml"},
                                                {"--truth", file("truth.json")},
                                                {"--report", file("r.json")},
                                                {"--range", "-5,30,-15,15"},
                                                {"--preset", "av2"}}) {
    EXPECT_GT(replay(words), 1) << words.front();
    EXPECT_THAT(output(), HasSubstr(words.front()));
  }
  EXPECT_GT(run({"replay", "--in", file("in.frames.jsonl"), "--domain", "7"}), 1);
  EXPECT_GT(run({"replay", "--in", file("in.frames.jsonl"), "--compression", "lz4"}), 1);
}

TEST_F(Commands, AReplayThatGivesNothingSaysWhy) {
  const auto advice = [&](const std::string& lines) {
    std::ofstream(file("in.jsonl")) << lines;
    EXPECT_EQ(run({"replay", "--in", file("in.jsonl")}), 0) << output();
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
  EXPECT_EQ(run({"replay", "--in", file("empty.jsonl")}), 1);
  EXPECT_THAT(output(), HasSubstr("is empty; a recording (MCAP) or frames"));
  EXPECT_THAT(advice(R"({"t":5e9,"pose":[0,0,0,0,0,0,1],"detections":[]})"),
              HasSubstr("all poses were refused, most of them as 'stamp'"));
  EXPECT_THAT(advice(R"({"t":1,"pose":[0,0,0,0,0,0,1],"detections":[]})"),
              HasSubstr("no map has a marking: no frame has a detection"));
  EXPECT_THAT(advice(drive(20, 0.1)), HasSubstr("confidence of 0.3 or more"));
  EXPECT_THAT(advice(drive(3, 0.9)), HasSubstr("3 frames were fused, and a lane needs about 5"));
  EXPECT_THAT(advice(drive(20, 0.9)),
              HasSubstr("no map has a lane: a lane needs a line or an edge on both sides"));
  simulate("none", "good.jsonl");
  EXPECT_EQ(run({"replay", "--in", file("good.jsonl")}), 0);
  EXPECT_THAT(output(), testing::Not(HasSubstr("no map")));
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
  ASSERT_EQ(run({"replay", "--in", file("zero.jsonl"), "--report", file("report.json")}), 0) << output();
  EXPECT_EQ(json::parse(content(file("report.json"))).at("frames"), 80);
  EXPECT_THAT(output(), testing::Not(HasSubstr("refused")));
}

TEST_F(Commands, ReplayOfADriveThatBeginsAgainClearsTheMap) {
  simulate("none", "in.frames.jsonl");
  const std::string frames = content(file("in.frames.jsonl"));
  std::ofstream(file("twice.frames.jsonl")) << frames << frames;
  ASSERT_EQ(run({"replay", "--in", file("twice.frames.jsonl"), "--report", file("report.json")}), 0)
      << output();
  EXPECT_THAT(output(), HasSubstr("map_resets "));
  const json counters = json::parse(content(file("report.json"))).at("counters");
  std::uint64_t frames_seen = 0;
  for (const auto& [name, count] : counters.items()) {
    if (name == "frames_fused" || name.starts_with("detections_refused"))
      frames_seen += count.get<std::uint64_t>();
  }
  EXPECT_EQ(frames_seen, 160U);
}

}  // namespace
}  // namespace laneloom
