#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "batch/drives.hpp"
#include "batch/slurm.hpp"
#include "support/child_process.hpp"
#include "temporary_folder.hpp"

namespace laneloom::batch {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

using Words = std::vector<std::string>;

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Three short drives, and the program as a process.
class Batch : public testing::Test {
 protected:
  Batch() {
    for (const char* name : {"a", "b", "night/c"}) simulate(name, name);
  }

  /// Names and contents of all outputs.
  std::map<std::string, std::string> outputs(const std::string& folder) const {
    std::map<std::string, std::string> result;
    for (const auto& entry : fs::recursive_directory_iterator(file(folder)))
      if (entry.is_regular_file() && entry.path().extension() == ".mcap" &&
          entry.path().string().find("/.batch/") == std::string::npos)
        result.emplace(entry.path().lexically_relative(file(folder)).string(), text_of(entry.path()));
    return result;
  }

  void simulate(const std::string& name, const std::string& seed) {
    fs::create_directories(fs::path(drive(name)).parent_path());
    ASSERT_EQ(run({"simulate", "--scenario", "straight", "--noise", "inhouse", "--duration", "3", "--seed",
                   std::to_string(1 + seed.size()), "--frames", drive(name), "--truth",
                   file("drives/" + name + ".truth.json")}),
              0)
        << output();
  }

  std::string drive(const std::string& name) const { return file("drives/" + name + ".frames.jsonl"); }
  std::string file(const std::string& name) const { return folder_.file(name); }
  std::string output() const { return text_of(file("output")); }

  int run(Words words) const {
    words.insert(words.begin(), LANELOOM_COMMAND);
    return support::ChildProcess(words, file("output")).wait();
  }
  int batch(const std::string& out, const Words& step, const Words& options = {}) const {
    Words words{"batch", "--drives", file("drives"), "--out", file(out)};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), step.begin(), step.end());
    return run(words);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Batch, MakesAnOutputOfEachDriveAsTheStepAloneDoes) {
  ASSERT_EQ(batch("maps", {"replay"}), 0) << output();
  EXPECT_THAT(output(), HasSubstr("3 drives: 3 made"));
  ASSERT_EQ(outputs("maps").size(), 3U);
  ASSERT_EQ(run({"replay", drive("night/c"), "--out", file("alone.mcap")}), 0);
  EXPECT_EQ(outputs("maps").at("night/c.maps.mcap"), text_of(file("alone.mcap")));
}

TEST_F(Batch, OneProcessAndTwoGiveTheSame) {
  ASSERT_EQ(batch("one", {"replay"}, {"--jobs", "1", "--json", file("one.json")}), 0);
  ASSERT_EQ(batch("two", {"replay"}, {"--jobs", "2", "--json", file("two.json")}), 0);
  EXPECT_EQ(outputs("one"), outputs("two"));
  EXPECT_EQ(text_of(file("one.json")), text_of(file("two.json")));
}

TEST_F(Batch, GoesOnWhereItStopped) {
  ASSERT_EQ(batch("maps", {"replay"}), 0);
  const auto whole = outputs("maps");
  fs::remove(file("maps/b.maps.mcap"));
  ASSERT_EQ(batch("maps", {"replay"}), 0);
  EXPECT_THAT(output(), HasSubstr("1 made"));
  EXPECT_THAT(output(), HasSubstr("2 kept"));
  EXPECT_EQ(outputs("maps"), whole);
}

TEST_F(Batch, MakesAnewWhatIsMadeOfSomethingElse) {
  std::ofstream(file("car.yaml")) << "mapper: {lane: {min_width_m: 2.2}}";
  const Words replay{"replay", "--config", file("car.yaml")};
  ASSERT_EQ(batch("maps", replay), 0);
  simulate("a", "another seed");
  ASSERT_EQ(batch("maps", replay), 0);
  EXPECT_THAT(output(), HasSubstr("1 made")) << "of a drive that is another one";
  std::ofstream(file("car.yaml")) << "mapper: {lane: {min_width_m: 2.1}}";
  ASSERT_EQ(batch("maps", replay), 0);
  EXPECT_THAT(output(), HasSubstr("3 made")) << "with another configuration";
  ASSERT_EQ(batch("maps", {"replay"}), 0);
  EXPECT_THAT(output(), HasSubstr("3 made")) << "with other options";
}

TEST_F(Batch, KeepsWhatIsMadeOfADriveThatWasCopied) {
  ASSERT_EQ(batch("maps", {"replay"}), 0);
  const std::string content = text_of(drive("a"));
  std::ofstream(drive("a")) << content;
  ASSERT_EQ(batch("maps", {"replay"}), 0);
  EXPECT_THAT(output(), HasSubstr("3 kept"));
}

TEST_F(Batch, ADriveThatFailsIsToldAndStopsNoOther) {
  std::ofstream(drive("broken")) << "{\"t\": 1}\n";
  ASSERT_EQ(batch("maps", {"replay"}, {"--json", file("table.json")}), 2);
  EXPECT_THAT(output(), HasSubstr("broken"));
  EXPECT_THAT(output(), HasSubstr("pose: is missing"));
  EXPECT_THAT(output(), HasSubstr("3 made"));
  EXPECT_EQ(outputs("maps").size(), 3U);
  const auto table = nlohmann::json::parse(text_of(file("table.json")));
  EXPECT_EQ(table.at("drives").at(2).at("failed"), true);
  ASSERT_EQ(batch("maps", {"replay"}), 2) << "it is tried again";
  EXPECT_THAT(output(), HasSubstr("3 kept, 1 failed"));
}

TEST_F(Batch, OneThatIsKilledLeavesNoHalfOutput) {
  {
    support::ChildProcess batch({LANELOOM_COMMAND, "batch", "--drives", file("drives"), "--out", file("maps"),
                                 "--jobs", "1", "replay"},
                                file("output"));
    while (batch.running() && (!fs::exists(file("maps/.batch")) || fs::is_empty(file("maps/.batch"))))
      std::this_thread::yield();
    batch.signal(SIGKILL);
    batch.wait();
  }
  const auto left = outputs("maps");
  ASSERT_EQ(batch("maps", {"replay"}), 0);
  const auto whole = outputs("maps");
  EXPECT_EQ(whole.size(), 3U);
  for (const auto& [name, content] : left) EXPECT_EQ(content, whole.at(name)) << name;
}

TEST_F(Batch, FiguresAreSummedUpOverDrives) {
  ASSERT_EQ(batch("rated", {"evaluate"}, {"--json", file("table.json")}), 0) << output();
  EXPECT_THAT(output(), HasSubstr("fused/lane/f1"));
  const auto figure = nlohmann::json::parse(text_of(file("table.json"))).at("figures").at("fused/lane/f1");
  double sum = 0.0;
  for (const char* name : {"a", "b", "night/c"})
    sum += nlohmann::json::parse(text_of(file("rated/" + std::string(name) + ".json")))
               .at("fused")
               .at("lane")
               .at("f1")
               .get<double>();
  EXPECT_EQ(figure.at("drives"), 3);
  EXPECT_NEAR(figure.at("mean").get<double>(), sum / 3.0, 1e-12);
  EXPECT_LE(figure.at("least").at("value"), figure.at("mean"));
  EXPECT_GE(figure.at("most").at("value"), figure.at("mean"));
}

TEST_F(Batch, WhatChecksFindIsNoFailure) {
  ASSERT_EQ(run({"simulate", "--scenario", "town", "--duration", "30", "--frames", file("sound")}), 0);
  std::istringstream lines(text_of(file("sound")));
  std::ofstream mirrored(drive("mirrored"));
  for (std::string line; std::getline(lines, line);) {
    auto frame = nlohmann::json::parse(line);
    for (auto& detection : frame["detections"])
      for (auto& point : detection["points"]) point[1] = -point[1].get<double>();
    mirrored << frame << "\n";
  }
  mirrored.close();
  ASSERT_EQ(batch("checked", {"check"}), 0) << output();
  EXPECT_THAT(output(), HasSubstr("something wrong was found"));
  EXPECT_FALSE(nlohmann::json::parse(text_of(file("checked/mirrored.json"))).at("findings").empty());
}

TEST_F(Batch, WhatWasLearnedIsMerged) {
  ASSERT_EQ(batch("learned", {"learn"}), 0) << output();
  EXPECT_THAT(text_of(file("learned/merged.yaml")), HasSubstr("3 drives"));
  ASSERT_EQ(run({"replay", drive("a"), "--config",
                 [&] {
                   std::ofstream(file("car.yaml"))
                       << "mapper: {fusion: {profile_file: " << file("learned/merged.yaml") << "}}";
                   return file("car.yaml");
                 }()}),
            0)
      << output();
}

TEST_F(Batch, TasksShareTheDrives) {
  ASSERT_EQ(batch("maps", {"replay"}, {"--task", "1/2"}), 0);
  EXPECT_THAT(output(), HasSubstr("2 drives: 2 made"));
  ASSERT_EQ(batch("maps", {"replay"}, {"--task", "2/2"}), 0);
  EXPECT_THAT(output(), HasSubstr("1 drives: 1 made"));
  ASSERT_EQ(batch("maps", {"replay"}), 0);
  EXPECT_THAT(output(), HasSubstr("3 kept"));
  for (const char* wrong : {"0/2", "3/2", "1", "1/x", "1/2x"})
    EXPECT_EQ(batch("maps", {"replay"}, {"--task", wrong}), 64) << wrong;
}

// A shell runs the scripts here, as nodes of a cluster do; tools/check-slurm has a real one.
TEST_F(Batch, TheScriptsForSlurmMakeTheSame) {
  const std::string out = file("it's a folder");
  ASSERT_EQ(run({"batch", "--drives", file("drives"), "--out", out, "--slurm", "--dry-run", "--tasks", "2",
                 "replay"}),
            0)
      << output();
  const fs::path scripts = fs::path(out) / ".batch";
  EXPECT_THAT(text_of(scripts / "array.sh"), HasSubstr("#SBATCH --array=1-2\n"));
  for (const char* task : {"1", "2"})
    EXPECT_EQ(support::ChildProcess({"/usr/bin/env", std::string("SLURM_ARRAY_TASK_ID=") + task, "sh",
                                     (scripts / "array.sh").string()},
                                    file("output"))
                  .wait(),
              0)
        << output();
  EXPECT_EQ(support::ChildProcess({"/bin/sh", (scripts / "summary.sh").string()}, file("output")).wait(), 0);
  EXPECT_THAT(output(), HasSubstr("3 kept"));
  ASSERT_EQ(batch("here", {"replay"}), 0);
  EXPECT_EQ(outputs("it's a folder"), outputs("here"));
  EXPECT_TRUE(fs::exists(fs::path(out) / "batch.json"));
}

TEST_F(Batch, WrongStepsAndDrivesAreNamed) {
  EXPECT_EQ(batch("maps", {"view"}), 1);
  EXPECT_THAT(output(), HasSubstr("'view' is no step of a batch; these are: replay, evaluate"));
  EXPECT_EQ(batch("maps", {"replay", "--out", "mine"}), 1);
  EXPECT_THAT(output(), HasSubstr("batch names the output of each drive"));
  EXPECT_EQ(batch("maps", {}), 64);
  EXPECT_EQ(run({"batch", "--drives", file("nowhere*"), "--out", file("maps"), "replay"}), 1);
  EXPECT_THAT(output(), HasSubstr("nowhere*: there is no such drive"));
}

class Drives : public testing::Test {
 protected:
  Words names(const Words& words, const std::string& list = "") const {
    Words names;
    for (const Drive& drive : find_drives(words, list)) names.push_back(drive.name);
    return names;
  }
  void touch(const std::string& name) const {
    fs::create_directories(fs::path(folder_.file(name)).parent_path());
    std::ofstream(folder_.file(name)) << "x";
  }
  TemporaryFolder folder_;
};

TEST_F(Drives, AreThoseOfFoldersPatternsAndLists) {
  for (const char* name : {"1/a.mcap", "1/b.frames.jsonl", "2/a.mcap", "2/notes.txt", "2/maps.jsonl"})
    touch(name);
  EXPECT_THAT(names({folder_.file("1"), folder_.file("2")}), ElementsAre("1/a", "1/b", "2/a"));
  EXPECT_THAT(names({folder_.file("*/a.mcap")}), ElementsAre("1/a", "2/a"));
  EXPECT_THAT(names({folder_.file("1/a.mcap"), folder_.file("1")}), ElementsAre("a", "b"));
  std::ofstream(folder_.file("list.txt")) << "# of one night\n1/a.mcap\n\n2\n";
  EXPECT_THAT(names({}, folder_.file("list.txt")), ElementsAre("1/a", "2/a"));
}

TEST_F(Drives, OfOneNameAreRefused) {
  touch("a.mcap");
  touch("a.frames.jsonl");
  EXPECT_THAT([&] { names({folder_.file("*")}); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("would have one output")));
}

}  // namespace
}  // namespace laneloom::batch
