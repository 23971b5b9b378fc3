#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/feather_writer.hpp"
#include "io/json_lines.hpp"
#include "laneloom/recording.hpp"
#include "own_domain.hpp"
#include "process.hpp"
#include "temporary_folder.hpp"

namespace laneloom {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Runs the real `laneloom` in a folder of its own.
class Commands : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }

  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), LANELOOM_COMMAND);
    return Process(arguments, file("output")).wait();
  }
  std::string output() const { return content(file("output")); }

  /// Frames and their poses as they would have been recorded.
  void write_recording(const std::string& frames, const std::string& recording) {
    RecordingWriter out(file(recording));
    JsonLinesReader in(file(frames));
    while (const auto record = in.next_frame()) {
      out.write(record->pose, record->pose.stamp_ns);
      out.write(record->frame, record->frame.stamp_ns);
    }
    out.close();
  }

  void simulate(const std::string& noise, const std::string& frames) {
    ASSERT_EQ(run({"simulate", "--scenario", "straight", "--noise", noise, "--duration", "8", "--frames",
                   file(frames), "--truth", file("truth.json")}),
              0)
        << output();
  }

 private:
  const TemporaryFolder folder_;
};

TEST_F(Commands, DetectionsWithoutNoiseScorePerfectly) {
  simulate("none", "in.frames.jsonl");
  ASSERT_EQ(run({"evaluate", "--truth", file("truth.json"), "--frames", file("in.frames.jsonl"), "--json",
                 file("score.json")}),
            0)
      << output();
  const json score = json::parse(content(file("score.json"))).at("raw");
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
    std::ofstream(file("data/val/" + log + "/map/log_map_archive_x.json"))
        << R"({"lane_segments":{},"drivable_areas":{}})";
  }
  ASSERT_EQ(
      run({"simulate", "--argoverse2", file("data"), "--frames", file("frames"), "--truth", file("truth")}),
      0)
      << output();
  for (const std::string log : {"log_a", "log_b"}) {
    EXPECT_GT(content(file("frames/" + log + ".frames.jsonl")).size(), 100u);
    EXPECT_THAT(content(file("truth/" + log + ".truth.json")), HasSubstr(log));
  }
  EXPECT_EQ(run({"publish", "--argoverse2", file("data"), "--duration", "1"}), 1);
  EXPECT_THAT(output(), HasSubstr("holds 2 logs; name one"));
}

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

TEST_F(Commands, ReplayWritesRecordingsToo) {
  simulate("inhouse", "in.frames.jsonl");
  ASSERT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--out", file("maps.mcap")}), 0) << output();
  RecordingReader reader(file("maps.mcap"));
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

TEST_F(Commands, FusedMapsAreEvaluatedAtTheStampsThatDetectionsHaveToo) {
  simulate("none", "in.frames.jsonl");
  ASSERT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--out", file("map.jsonl")}), 0) << output();
  std::string shorter = content(file("map.jsonl"));
  shorter.erase(0, shorter.find('\n') + 1);
  std::ofstream(file("shorter.jsonl")) << shorter;
  ASSERT_EQ(run({"evaluate", "--truth", file("truth.json"), "--frames", file("in.frames.jsonl"), "--map",
                 file("shorter.jsonl"), "--json", file("score.json")}),
            0)
      << output();
  const json score = json::parse(content(file("score.json")));
  EXPECT_EQ(score.at("raw").at("frames"), 79);
  EXPECT_EQ(score.at("fused").at("frames"), 79);
  EXPECT_GT(score.at("fused").at("lane").at("matched"), 0);
}

TEST_F(Commands, RenderDrawsEveryInput) {
  simulate("none", "in.frames.jsonl");
  ASSERT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--out", file("map.jsonl")}), 0) << output();
  ASSERT_EQ(run({"render", "--truth", file("truth.json"), "--frames", file("in.frames.jsonl"), "--map",
                 file("map.jsonl"), "--sequence", "2", "--out", file("map.png")}),
            0)
      << output();
  EXPECT_EQ(content(file("map.png")).substr(1, 3), "PNG");
  ASSERT_EQ(run({"render", "--truth", file("truth.json"), "--at", "3", "--out", file("truth.svg")}), 0)
      << output();
  EXPECT_THAT(content(file("truth.svg")), HasSubstr("</svg>"));
}

TEST_F(Commands, EveryCommandTakesRecordingsAndLines) {
  simulate("none", "in.frames.jsonl");
  ASSERT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--out", file("map.jsonl")}), 0) << output();
  ASSERT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--out", file("map.mcap")}), 0) << output();
  write_recording("in.frames.jsonl", "in.mcap");
  std::vector<std::string> pictures;
  for (const char* const frames : {"in.frames.jsonl", "in.mcap"}) {
    for (const char* const map : {"map.jsonl", "map.mcap"}) {
      ASSERT_EQ(
          run({"render", "--frames", file(frames), "--map", file(map), "--at", "3", "--out", file("x.svg")}),
          0)
          << output();
      pictures.push_back(content(file("x.svg")));
      ASSERT_EQ(
          run({"evaluate", "--truth", file("truth.json"), "--frames", file(frames), "--map", file(map)}), 0)
          << output();
    }
    ASSERT_EQ(run({"replay", "--in", file(frames)}), 0) << output();
  }
  EXPECT_THAT(pictures, testing::Each(pictures.front()));
}

TEST_F(Commands, ACommandThatThereIsNotIsNamedWithTheNearest) {
  EXPECT_EQ(run({"frobnicate"}), 64);
  EXPECT_THAT(output(), HasSubstr("there is no command 'frobnicate'; the nearest is"));
  EXPECT_EQ(run({"evalute", "--truth", "x"}), 64);
  EXPECT_THAT(output(), HasSubstr("there is no command 'evalute'; the nearest is 'evaluate'"));
  EXPECT_EQ(run({"import", "argoverse"}), 64);
  EXPECT_THAT(output(), HasSubstr("there is no command 'argoverse'; the nearest is 'argoverse2'"));
  EXPECT_EQ(run({"bench", "worse"}), 64);
}

TEST_F(Commands, WrongUseHasOneExitCode) {
  EXPECT_EQ(run({}), 64);
  EXPECT_EQ(run({"--nonsense"}), 64);
  EXPECT_EQ(run({"replay"}), 64) << "an option is missing";
  EXPECT_EQ(run({"pnc", "--duration", "soon"}), 64);
  EXPECT_EQ(run({"simulate", "--scenario", "nowhere", "--frames", file("x")}), 64);
  EXPECT_EQ(run({"import", "--help"}), 0);
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_THAT(output(), HasSubstr("Exit codes: 0 done; 1 it failed;"));
}

TEST_F(Commands, AFileThatIsNotThereIsAFailureOfEveryCommand) {
  const std::string absent = file("absent");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"replay", "--in", absent},
        {"render", "--map", absent, "--out", file("x.svg")},
        {"evaluate", "--truth", absent, "--map", absent},
        {"simulate", "--argoverse2", absent, "--frames", file("x")},
        {"simulate", "--lanelet2", absent, "--frames", file("x")},
        {"experiment", "--argoverse2", absent},
        {"drive", "--scenario", "hill", "--config", absent},
        {"bench", "--config", absent},
        {"bench", "--duration", "5", "--peer", absent},
        {"bench", "latency", "--identities", absent},
        {"experiment", "--scenario", "hill", "--duration", "5", "--config", "default", "--peer", absent},
        {"import", "argoverse2", absent, "--out", file("x")}}) {
    EXPECT_EQ(run(words), 1) << words.front() << output();
    EXPECT_THAT(output(), HasSubstr(absent)) << words.front();
  }
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
  EXPECT_THAT(advice(""), HasSubstr("no map came of it: the input has no detections"));
  EXPECT_THAT(advice(R"({"t":-1,"pose":[0,0,0,0,0,0,1],"detections":[]})"),
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

TEST_F(Commands, WrongInputIsNamed) {
  EXPECT_EQ(run({"replay", "--in", file("missing.jsonl")}), 1);
  EXPECT_THAT(output(), HasSubstr("missing.jsonl"));
  std::ofstream(file("broken.jsonl")) << "\n{\"t\": 1}\n";
  EXPECT_EQ(run({"replay", "--in", file("broken.jsonl")}), 1);
  EXPECT_THAT(output(), HasSubstr("broken.jsonl:2: pose"));
  EXPECT_EQ(run({"evaluate", "--truth", file("broken.jsonl"), "--map", file("broken.jsonl")}), 1);
  EXPECT_NE(run({"simulate", "--scenario", "nowhere", "--frames", file("x")}), 0);
  EXPECT_NE(run({"simulate", "--frames", file("x")}), 0);
  EXPECT_NE(run({"render", "--truth", file("broken.jsonl"), "--out", file("x.png")}), 0);
  EXPECT_NE(run({}), 0);
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

TEST_F(Commands, NumbersThatAreNoneOrFarTooLargeAreRefused) {
  simulate("none", "in.frames.jsonl");
  const auto refused = [&](const std::vector<std::string>& words) {
    EXPECT_GT(run(words), 0) << testing::PrintToString(words);
    EXPECT_THAT(output(), HasSubstr(words.end()[-2])) << testing::PrintToString(words);
  };
  for (const char* number : {"nan", "1e18"}) {
    const std::string frames = file("x.jsonl");
    refused({"simulate", "--scenario", "hill", "--frames", frames, "--duration", number});
    EXPECT_FALSE(std::filesystem::exists(frames));
    refused({"publish", "--scenario", "hill", "--loop", "--duration", number});
    refused({"publish", "--scenario", "hill", "--speed-up", number});
    refused({"record", "--duration", "0.1", "--out", file("x.mcap"), "--max-size", number});
    refused({"drive", "--scenario", "hill", "--km", number});
    refused({"evaluate", "--truth", file("truth.json"), "--frames", file("in.frames.jsonl"),
             "--min-confidence", number});
    refused({"render", "--truth", file("truth.json"), "--out", file("x.svg"), "--at", number});
  }
  EXPECT_EQ(run({"render", "--truth", file("truth.json"), "--out", file("x.svg"), "--at", "-1"}), 1);
}

TEST_F(Commands, OutputThatCannotBeWrittenIsAFailure) {
  simulate("none", "in.frames.jsonl");
  const std::string command = LANELOOM_COMMAND;
  for (const std::string& words :
       {std::string("publish --list"), std::string("--version"), std::string("drive --help"),
        "evaluate --truth " + file("truth.json") + " --frames " + file("in.frames.jsonl")}) {
    const std::string line = command + " " + words + " >/dev/full 2>" + file("errors");
    EXPECT_EQ(Process({"/bin/sh", "-c", line}, file("output")).wait(), 1) << words;
    EXPECT_THAT(content(file("errors")), HasSubstr("standard output cannot be written")) << words;
  }
}

TEST_F(Commands, PublishListsItsRoads) {
  EXPECT_EQ(run({"publish", "--list"}), 0);
  EXPECT_THAT(output(), HasSubstr("town"));
}

/// Real processes over real DDS, in a domain of the test's own.
class Loopback : public Commands {
 protected:
  std::vector<std::string> command(std::vector<std::string> words) const {
    const std::string domain = std::to_string(own_domain());
    words.insert(words.end(), {"--domain", domain, "--vehicle-id", "test"});
    return words;
  }
};

TEST_F(Loopback, PncWithoutServiceSaysSo) { EXPECT_EQ(run(command({"pnc", "--duration", "0.5"})), 3); }

TEST_F(Loopback, LanesReachThePlanner) {
  Process service(command({LANELOOM_SERVICE}), file("service.log"));
  Process publisher(
      command({LANELOOM_COMMAND, "publish", "--scenario", "straight", "--loop", "--wait-for-readers", "1",
               "--frames", file("frames.jsonl"), "--truth", file("truth.json")}),
      file("publish.log"));
  Process planner(command({LANELOOM_COMMAND, "pnc", "--json", "--require-lanes", "--duration", "20",
                           "--record", file("map.jsonl")}),
                  file("pnc.log"));
  EXPECT_EQ(planner.wait(), 0) << content(file("pnc.log")).substr(0, 4000) << content(file("service.log"));
  publisher.signal(SIGTERM);
  EXPECT_EQ(publisher.wait(), 0) << content(file("publish.log"));
  service.signal(SIGTERM);
  EXPECT_EQ(service.wait(), 0) << content(file("service.log"));

  ASSERT_EQ(run({"evaluate", "--truth", file("truth.json"), "--frames", file("frames.jsonl"), "--map",
                 file("map.jsonl"), "--json", file("score.json")}),
            0)
      << output();
  const json fused = json::parse(content(file("score.json"))).at("fused");
  EXPECT_GT(fused.at("frames"), 10);
  EXPECT_GT(fused.at("lane").at("precision"), 0.9);
}

/// A drive's recording, made while `driver` publishes it to a service.
class RecordedLoopback : public Loopback {
 protected:
  void record(std::vector<std::string> driver, const std::string& name) {
    Process service(command({LANELOOM_SERVICE}), file("service.log"));
    Process recorder(command({LANELOOM_COMMAND, "record", "--out", file(name)}), file("record.log"));
    for (int i = 0; i < 600 && !has_map(file(name)); ++i) usleep(50'000);
    driver.insert(driver.begin(), LANELOOM_COMMAND);
    driver.insert(driver.end(), {"--wait-for-readers", "2"});
    Process publisher(command(driver), file("publish.log"));
    ASSERT_EQ(publisher.wait(), 0) << content(file("publish.log"));
    sleep(3);
    recorder.signal(SIGTERM);
    ASSERT_EQ(recorder.wait(), 0) << content(file("record.log"));
  }

 private:
  /// The service publishes maps before anything comes.
  static bool has_map(const std::string& recording) {
    if (content(recording).empty()) return false;
    RecordingReader reader(recording);
    while (const auto message = reader.next())
      if (std::holds_alternative<PublishedMap>(message->message)) return true;
    return false;
  }
};

TEST_F(RecordedLoopback, AReplayMakesTheMapsThatTheServicePublished) {
  record({"publish", "--scenario", "split", "--noise", "inhouse", "--duration", "8"}, "live.mcap");
  ASSERT_EQ(run({"replay", "--in", file("live.mcap"), "--verify", "--report", file("live.json")}), 0)
      << output();
  const json live = json::parse(content(file("live.json")));
  EXPECT_GE(live.at("frames"), 77);
  // With another configuration they are others, and that is seen.
  EXPECT_EQ(run({"replay", "--in", file("live.mcap"), "--verify", "--preset", "av2"}), 2) << output();

  // Published again, the same messages make the same maps, in the service and in a replay.
  record({"replay", "--in", file("live.mcap"), "--publish", "--speed-up", "2"}, "again.mcap");
  ASSERT_EQ(run({"replay", "--in", file("again.mcap"), "--verify", "--report", file("again.json")}), 0)
      << output();
  EXPECT_EQ(json::parse(content(file("again.json"))).at("hash"), live.at("hash"));
}

TEST_F(Loopback, ThePlannerOutlivesTheService) {
  const std::string ok = "\"state\":\"OK\"";
  const auto seen = [&](const std::string& event) {
    const std::string log = content(file("pnc.log"));
    int count = 0;
    for (auto at = log.find(event); at != std::string::npos; at = log.find(event, at + 1)) ++count;
    return count;
  };
  const auto wait_for = [&](const std::string& event, int times) {
    for (int i = 0; i < 600 && seen(event) < times; ++i) usleep(50'000);
    return seen(event) >= times;
  };

  Process publisher(command({LANELOOM_COMMAND, "publish", "--scenario", "straight", "--loop"}),
                    file("publish.log"));
  Process planner(command({LANELOOM_COMMAND, "pnc", "--json"}), file("pnc.log"));
  auto service = std::make_unique<Process>(command({LANELOOM_SERVICE}), file("service.log"));
  ASSERT_TRUE(wait_for(ok, 1));
  service.reset();  // kill -9
  ASSERT_TRUE(wait_for("liveliness_lost", 1));
  const int before = seen(ok);
  service = std::make_unique<Process>(command({LANELOOM_SERVICE}), file("service.log"));
  EXPECT_TRUE(wait_for(ok, before + 1));
  planner.signal(SIGTERM);
  EXPECT_EQ(planner.wait(), 0) << content(file("pnc.log")).substr(0, 4000);
}

}  // namespace
}  // namespace laneloom
