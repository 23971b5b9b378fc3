#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
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
#include "batch/run.hpp"
#include "batch/slurm.hpp"
#include "commands.hpp"

namespace laneloom::batch {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kBatch = "batch --drives drives --out ";

/// Three short drives, and the program as a process.
class Batch : public Commands {
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
        result.emplace(entry.path().lexically_relative(file(folder)).string(), content(entry.path()));
    return result;
  }

  void simulate(const std::string& name, const std::string& seed) {
    fs::create_directories(fs::path(file(drive(name))).parent_path());
    ASSERT_TRUE(done("simulate --scenario straight --noise inhouse --duration 3 --seed " +
                     std::to_string(1 + seed.size()) + " --frames " + drive(name) + " --truth drives/" +
                     name + ".truth.json"));
  }

  static std::string drive(const std::string& name) { return "drives/" + name + ".frames.jsonl"; }
};

TEST_F(Batch, MakesAnOutputOfEachDriveAsTheStepAloneDoes) {
  ASSERT_TRUE(done(kBatch + "maps replay"));
  EXPECT_THAT(output(), HasSubstr("3 drives: 3 made"));
  ASSERT_EQ(outputs("maps").size(), 3U);
  ASSERT_TRUE(done("replay " + drive("night/c") + " --out alone.mcap"));
  EXPECT_EQ(outputs("maps").at("night/c.maps.mcap"), text("alone.mcap"));
}

TEST_F(Batch, OneProcessAndTwoGiveTheSame) {
  ASSERT_TRUE(done(kBatch + "one --jobs 1 --json one.json replay"));
  ASSERT_TRUE(done(kBatch + "two --jobs 2 --json two.json replay"));
  EXPECT_EQ(outputs("one"), outputs("two"));
  EXPECT_EQ(text("one.json"), text("two.json"));
}

TEST_F(Batch, GoesOnWhereItStopped) {
  ASSERT_TRUE(done(kBatch + "maps replay"));
  const auto whole = outputs("maps");
  fs::remove(file("maps/b.maps.mcap"));
  ASSERT_TRUE(done(kBatch + "maps replay"));
  EXPECT_THAT(output(), HasSubstr("1 made"));
  EXPECT_THAT(output(), HasSubstr("2 kept"));
  EXPECT_EQ(outputs("maps"), whole);
}

TEST_F(Batch, MakesAnewWhatIsMadeOfSomethingElse) {
  std::ofstream(file("car.yaml")) << "mapper: {lane: {min_width_m: 2.2}}";
  const std::string replay = "maps replay --config car.yaml";
  ASSERT_TRUE(done(kBatch + replay));
  simulate("a", "another seed");
  ASSERT_TRUE(done(kBatch + replay));
  EXPECT_THAT(output(), HasSubstr("1 made")) << "of a drive that is another one";
  std::ofstream(file("car.yaml")) << "mapper: {lane: {min_width_m: 2.1}}";
  ASSERT_TRUE(done(kBatch + replay));
  EXPECT_THAT(output(), HasSubstr("3 made")) << "with another configuration";
  ASSERT_TRUE(done(kBatch + "maps replay"));
  EXPECT_THAT(output(), HasSubstr("3 made")) << "with other options";
}

TEST_F(Batch, MakesAnewWhatIsMadeOfAnotherFileThatAnOptionNamesInAnyWay) {
  ASSERT_TRUE(done("learn " + drive("a") + " --out profile.yaml"));
  std::ofstream(file("car.yaml")) << "mapper: {fusion: {profile_file: profile.yaml}}";
  const auto made = [&] {
    EXPECT_TRUE(done(kBatch + "maps replay --config=car.yaml"));
    return output().find("3 made") != std::string::npos;
  };
  EXPECT_TRUE(made());
  EXPECT_FALSE(made());
  ASSERT_TRUE(done("learn " + drive("night/c") + " --out profile.yaml"));
  EXPECT_TRUE(made()) << "with another profile";
  std::ofstream(file("car.yaml")) << "mapper: {lane: {min_width_m: 2.2}}";
  EXPECT_TRUE(made()) << "with another configuration";
}

TEST_F(Batch, ItsOwnOutputsAreNoDrives) {
  for (const std::string step : {"replay", "replay", "replay --preset av2"}) {
    ASSERT_TRUE(done("batch --drives . --out maps " + step));
    EXPECT_THAT(output(), HasSubstr("3 drives: ")) << step;
  }
  ASSERT_TRUE(done("batch --drives drives --out drives replay"));
  ASSERT_TRUE(done("batch --drives drives --out drives replay"));
  EXPECT_THAT(output(), HasSubstr("3 drives: 0 made"));
  fs::create_directory_symlink(file("drives"), file("link"));
  ASSERT_TRUE(done("batch --drives link --out drives replay"));
  EXPECT_THAT(output(), HasSubstr("3 drives: ")) << "through a link";
  ASSERT_TRUE(done("batch --drives maps --out roads export"));
  EXPECT_THAT(output(), HasSubstr("3 drives: 3 made")) << "outputs of another batch may be drives";
}

TEST_F(Batch, FilesOfOthersAreNotWrittenOver) {
  std::ofstream(file("drives/a.maps.mcap")) << "mine";
  std::ofstream(file("drives/b.log")) << "mine";
  ASSERT_EQ(run("batch --drives " + drive("a") + " --drives " + drive("b") + " --out drives replay"), 2);
  EXPECT_THAT(output(), HasSubstr("a.maps.mcap: is there, and no batch made it"));
  EXPECT_EQ(text("drives/a.maps.mcap"), "mine");
  EXPECT_EQ(text("drives/b.log"), "mine");
}

TEST_F(Batch, SummariesAreNotWrittenOverDrivesAndOutputs) {
  std::ofstream(file("list.txt")) << "drives\n";
  for (const std::string name :
       {"drives/a.frames.jsonl", "rated/drives/a.json", "list.txt", "drives/a.truth.json"}) {
    EXPECT_EQ(run("batch --list list.txt --out rated --json " + name + " evaluate"), 1) << name;
    EXPECT_THAT(output(), HasSubstr(name)) << name;
  }
  EXPECT_EQ(run(kBatch + "rated --json nowhere/table.json evaluate"), 1);
  EXPECT_THAT(output(), HasSubstr("nowhere/table.json: its folder is not there"));
  EXPECT_FALSE(exists("rated/a.json")) << "told before the work";
  fs::rename(file(drive("a")), file(drive("merged")));
  EXPECT_EQ(run(kBatch + "learned learn"), 1);
  EXPECT_THAT(output(), HasSubstr("merged.yaml: is given as an output twice"));
  fs::rename(file(drive("merged")), file(drive("batch")));
  EXPECT_EQ(run(kBatch + "rated --slurm --dry-run evaluate"), 1);
  EXPECT_THAT(output(), HasSubstr("batch.json: is given as an output twice"));
}

TEST_F(Batch, KeepsWhatIsMadeOfADriveThatWasCopied) {
  ASSERT_TRUE(done(kBatch + "maps replay"));
  const std::string content = text(drive("a"));
  std::ofstream(file(drive("a"))) << content;
  ASSERT_TRUE(done(kBatch + "maps replay"));
  EXPECT_THAT(output(), HasSubstr("3 kept"));
}

TEST_F(Batch, AStepThatFailsLeavesTheOutputsOfBefore) {
  ASSERT_TRUE(done(kBatch + "maps replay"));
  const auto before = outputs("maps");
  ASSERT_EQ(run(kBatch + "maps replay --speed-pu 2"), 2);
  EXPECT_THAT(output(), HasSubstr("3 failed"));
  EXPECT_EQ(outputs("maps"), before);
  ASSERT_TRUE(done(kBatch + "maps replay"));
  EXPECT_THAT(output(), HasSubstr("3 kept"));
}

TEST_F(Batch, ADriveThatFailsIsToldAndStopsNoOther) {
  std::ofstream(file(drive("broken"))) << "{\"t\": 1}\n";
  ASSERT_EQ(run(kBatch + "maps --json table.json replay"), 2);
  EXPECT_THAT(output(), HasSubstr("broken"));
  EXPECT_THAT(output(), HasSubstr("pose: is missing"));
  EXPECT_THAT(output(), HasSubstr("3 made"));
  EXPECT_EQ(outputs("maps").size(), 3U);
  const auto table = json_of("table.json");
  EXPECT_EQ(table.at("drives").at(2).at("failed"), true);
  ASSERT_EQ(run(kBatch + "maps replay"), 2) << "it is tried again";
  EXPECT_THAT(output(), HasSubstr("3 kept, 1 failed"));
}

TEST_F(Batch, TheReasonOfAFailureIsTheComplaintAndNotWhatFollows) {
  ASSERT_TRUE(done("import frames " + drive("a") + " --out all.mcap"));
  ASSERT_TRUE(done("cut all.mcap --topic detections --out drives/poseless.mcap"));
  ASSERT_EQ(run(kBatch + "maps replay"), 2);
  EXPECT_THAT(output(), HasSubstr("poseless.mcap: no map came of it: the input has no poses (ended with"));
}

TEST_F(Batch, WrongOptionsOfTheStepAreNamed) {
  ASSERT_EQ(run(kBatch + "maps replay --preset nowhere"), 2);
  EXPECT_THAT(output(), HasSubstr("laneloom replay: --preset: nowhere"));
}

TEST_F(Batch, OneThatIsKilledLeavesNoHalfOutput) {
  {
    support::ChildProcess batch = start("laneloom " + kBatch + "maps --jobs 1 replay", "output");
    while (batch.running() && !exists("maps/.batch/a.maps.mcap")) std::this_thread::yield();
    batch.signal(SIGKILL);
    batch.wait();
  }
  const auto left = outputs("maps");
  ASSERT_TRUE(done(kBatch + "maps replay"));
  const auto whole = outputs("maps");
  EXPECT_EQ(whole.size(), 3U);
  for (const auto& [name, content] : left) EXPECT_EQ(content, whole.at(name)) << name;
}

TEST_F(Batch, NamesNeedNotBeText) {
  fs::create_directories(file("named"));
  fs::copy_file(file(drive("a")), file("named/dr\xffive.frames.jsonl"));
  ASSERT_TRUE(done("batch --drives named --out maps --json table.json replay"));
  EXPECT_EQ(json_of("table.json").at("drives").size(), 1U);
}

TEST_F(Batch, TheSummaryMayGoToStandardOutput) {
  ASSERT_TRUE(done(kBatch + "maps --json - replay 2>table"));
  EXPECT_EQ(json_of("output").at("drives").size(), 3U);
  EXPECT_THAT(text("table"), HasSubstr("3 drives: 3 made"));
}

TEST_F(Batch, FiguresAreSummedUpOverDrives) {
  ASSERT_TRUE(done(kBatch + "rated --json table.json evaluate"));
  EXPECT_THAT(output(), HasSubstr("fused/lane/f1"));
  const auto figure = json_of("table.json").at("figures").at("fused/lane/f1");
  double sum = 0.0, squares = 0.0;
  for (const char* name : {"a", "b", "night/c"}) {
    const double f1 =
        json_of("rated/" + std::string(name) + ".json").at("fused").at("lane").at("f1").get<double>();
    sum += f1;
    squares += f1 * f1;
  }
  const double stddev = std::sqrt((squares - sum * sum / 3.0) / 2.0);
  EXPECT_EQ(figure.at("drives"), 3);
  EXPECT_NEAR(figure.at("mean").get<double>(), sum / 3.0, 1e-12);
  EXPECT_NEAR(figure.at("interval_95").get<double>(), 4.303 * stddev / std::sqrt(3.0), 1e-6) << "Student's t";
  EXPECT_LE(figure.at("least").at("value"), figure.at("mean"));
  EXPECT_GE(figure.at("most").at("value"), figure.at("mean"));
}

TEST_F(Batch, WhatChecksFindIsNoFailure) {
  ASSERT_TRUE(done("simulate --scenario town --duration 30 --frames sound"));
  std::istringstream lines(text("sound"));
  std::ofstream mirrored(file(drive("mirrored")));
  for (std::string line; std::getline(lines, line);) {
    auto frame = nlohmann::json::parse(line);
    for (auto& detection : frame["detections"])
      for (auto& point : detection["points"]) point[1] = -point[1].get<double>();
    mirrored << frame << "\n";
  }
  mirrored.close();
  for (const std::string what : {"4 made", "4 kept"}) {
    ASSERT_TRUE(done(kBatch + "checked --json table.json check"));
    EXPECT_THAT(output(), HasSubstr(what));
    EXPECT_THAT(output(), HasSubstr("something wrong was found")) << what;
    const auto found = json_of("table.json").at("drives").at(2);
    EXPECT_EQ(found.at("drive"), "mirrored");
    EXPECT_EQ(found.value("found_something", false), true) << what;
  }
  EXPECT_FALSE(json_of("checked/mirrored.check.json").at("findings").empty());
}

TEST_F(Batch, StepsLeaveEachOthersOutputs) {
  ASSERT_TRUE(done(kBatch + "both evaluate"));
  ASSERT_TRUE(done(kBatch + "both check"));
  ASSERT_TRUE(done(kBatch + "both evaluate"));
  EXPECT_THAT(output(), HasSubstr("3 kept"));
}

TEST_F(Batch, WhatWasLearnedIsMerged) {
  ASSERT_TRUE(done(kBatch + "learned learn"));
  EXPECT_THAT(text("learned/merged.yaml"), HasSubstr("3 drives"));
  std::ofstream(file("car.yaml")) << "mapper: {fusion: {profile_file: " << file("learned/merged.yaml")
                                  << "}}";
  ASSERT_TRUE(done("replay " + drive("a") + " --config car.yaml"));
}

TEST_F(Batch, TasksShareTheDrives) {
  ASSERT_TRUE(done(kBatch + "maps --task 1/2 replay"));
  EXPECT_THAT(output(), HasSubstr("2 drives: 2 made"));
  ASSERT_TRUE(done(kBatch + "maps --task 2/2 replay"));
  EXPECT_THAT(output(), HasSubstr("1 drives: 1 made"));
  ASSERT_TRUE(done(kBatch + "maps replay"));
  EXPECT_THAT(output(), HasSubstr("3 kept"));
  for (const std::string wrong : {"0/2", "3/2", "1", "1/x", "1/2x"})
    EXPECT_EQ(run(kBatch + "maps --task " + wrong + " replay"), 64) << wrong;
}

// A shell runs the scripts here, as nodes of a cluster do; tools/check-slurm has a real one.
TEST_F(Batch, TheScriptsForSlurmMakeTheSame) {
  ASSERT_TRUE(done(kBatch + "\"it's a folder\" --slurm --dry-run --tasks 2 replay"));
  EXPECT_THAT(text("it's a folder/.batch/array.sh"), HasSubstr("#SBATCH --array=1-2\n"));
  for (const std::string task : {"1", "2"})
    EXPECT_EQ(shell("env SLURM_ARRAY_TASK_ID=" + task + " sh \"it's a folder/.batch/array.sh\""), 0)
        << output();
  EXPECT_EQ(shell("sh \"it's a folder/.batch/summary.sh\""), 0);
  EXPECT_THAT(output(), HasSubstr("3 kept"));
  ASSERT_TRUE(done(kBatch + "here replay"));
  EXPECT_EQ(outputs("it's a folder"), outputs("here"));
  EXPECT_TRUE(exists("it's a folder/batch.json"));
}

TEST_F(Batch, TheStepMayFollowAnyOption) {
  ASSERT_TRUE(done("batch --out maps --drives drives replay"));
  for (const std::string option : {"--sbatch=--partition=night", "--sbatch --partition=night"})
    EXPECT_TRUE(done(kBatch + "maps --slurm --dry-run " + option + " replay"));
}

TEST_F(Batch, PathsInDirectivesOfSlurmAreQuoted) {
  ASSERT_TRUE(done(kBatch + "'two words 5%a' --slurm --dry-run replay"));
  EXPECT_THAT(text("two words 5%a/.batch/summary.sh"), HasSubstr("/two words 5%%a/batch.log\"\n"));
  EXPECT_THAT(text("two words 5%a/.batch/array.sh"), HasSubstr("/two words 5%%a/.batch\"/task-%a.log\n"));
}

TEST_F(Batch, JobsThatWaitKeepTheirDrives) {
  ASSERT_TRUE(done("batch --drives " + drive("a") + " --out maps --slurm --dry-run replay"));
  fs::rename(file("maps/.batch/array.sh"), file("waiting.sh"));
  ASSERT_TRUE(done("batch --drives " + drive("b") + " --out maps --slurm --dry-run replay"));
  ASSERT_EQ(shell("env SLURM_ARRAY_TASK_ID=1 sh waiting.sh"), 0) << output();
  EXPECT_TRUE(exists("maps/a.maps.mcap"));
  fs::copy_file(file(drive("a")), file("drives/a\nb.mcap"));
  EXPECT_EQ(run(kBatch + "maps --slurm --dry-run replay"), 1);
  EXPECT_THAT(output(), HasSubstr("line break"));
}

TEST_F(Batch, ADriveOfAListThatIsGoneFailsAlone) {
  std::ofstream(file("list.txt")) << "drives\ngone.mcap\n";
  ASSERT_EQ(run("batch --list list.txt --out maps replay"), 2);
  EXPECT_THAT(output(), HasSubstr("gone.mcap: there is no such drive"));
  EXPECT_THAT(output(), HasSubstr("3 made in"));
}

TEST_F(Batch, WrongStepsAndDrivesAreNamed) {
  EXPECT_EQ(run(kBatch + "maps view"), 1);
  EXPECT_THAT(output(), HasSubstr("'view' is no step of a batch; these are: replay, evaluate"));
  EXPECT_EQ(run(kBatch + "maps replay --out mine"), 1);
  EXPECT_THAT(output(), HasSubstr("batch names the output of each drive"));
  EXPECT_EQ(run(kBatch + "maps replay --out=mine"), 1);
  EXPECT_THAT(output(), HasSubstr("batch names the output of each drive"));
  for (const std::string step :
       {"replay --report", "evaluate --plots", "export --geojson", "export --opendrive", "export --report"}) {
    EXPECT_EQ(run(kBatch + "maps " + step + " mine"), 1);
    EXPECT_THAT(output(), HasSubstr(step + ": all drives would write to one place"));
  }
  EXPECT_EQ(run(kBatch + "maps"), 64);
  EXPECT_EQ(run("batch --drives 'nowhere*' --out maps replay"), 1);
  EXPECT_THAT(output(), HasSubstr("nowhere*: there is no such drive"));
}

/// A shell script in place of laneloom, which writes $out.
class Script : public testing::Test {
 protected:
  Script() {
    write("drive", "drive");
    write("car.yaml", "{}");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.file(name)) << text;
  }
  /// What becomes of a drive.
  Result result_of(const std::string& script) const {
    write("laneloom", "#!/bin/bash\ncd '" + folder_.path() + "'\nout=${!#}\n" + script + "\n");
    fs::permissions(folder_.file("laneloom"), fs::perms::owner_all);
    const Work work{.laneloom = folder_.file("laneloom"),
                    .step = {.name = "replay", .options = {"--config", folder_.file("car.yaml")}},
                    .folder = folder_.file("out")};
    return run(work, {{.path = folder_.file("drive"), .folder = folder_.path(), .name = "drive"}},
               [](double) {})
        .front();
  }
  TemporaryFolder folder_;
};

TEST_F(Script, WhatIsReadMustNotChangeMeanwhile) {
  for (const std::string name : {"drive", "car.yaml"}) {
    const Result result = result_of("echo x >$out; echo ' ' >>" + name);
    EXPECT_EQ(result.state, Result::State::failed) << name;
    EXPECT_THAT(result.problem, HasSubstr("changed meanwhile")) << name;
  }
  EXPECT_EQ(result_of("echo x >$out").state, Result::State::made);
  EXPECT_EQ(result_of("echo x >$out").state, Result::State::kept);
}

TEST_F(Script, AnOutputIsMadeByOneBatchAtATime) {
  const Result result = result_of("flock --nonblock out/.batch/drive.maps.mcap.lock true; echo $? >$out");
  EXPECT_EQ(result.state, Result::State::made);
  EXPECT_EQ(content(result.output), "1\n") << "another batch would wait";
  EXPECT_EQ(result_of("flock --nonblock out/.batch/drive.maps.mcap.lock true; echo $? >$out").state,
            Result::State::kept)
      << "the lock is free again";
}

TEST_F(Script, AnOutputThatWasEmptiedIsMadeAnew) {
  const Result result = result_of("echo x >$out");
  write("out/drive.maps.mcap", "");
  EXPECT_EQ(result_of("echo x >$out").state, Result::State::made);
  EXPECT_EQ(content(result.output), "x\n");
}

class Drives : public testing::Test {
 protected:
  std::vector<std::string> names(const std::vector<std::string>& words, const std::string& list = "") const {
    std::vector<std::string> names;
    for (const Drive& drive : find_drives(words, list, folder_.file("out"))) names.push_back(drive.name);
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
  std::ofstream(folder_.file("windows.txt")) << "# of one night\r\n1/a.mcap\r\n\r\n2\r\n";
  EXPECT_THAT(names({}, folder_.file("windows.txt")), ElementsAre("1/a", "2/a"));
}

TEST_F(Drives, KeepTheirNamesWhenOthersCome) {
  touch("nights/monday/a.mcap");
  EXPECT_THAT(names({folder_.file("nights")}), ElementsAre("monday/a"));
  EXPECT_THAT(names({folder_.file("nights/*/a.mcap")}), ElementsAre("monday/a"));
  EXPECT_THAT(names({folder_.file("nights/*")}), ElementsAre("monday/a"));
  EXPECT_THAT(names({folder_.file("nights/./monday/a.mcap")}), ElementsAre("monday/a"));
  std::ofstream(folder_.file("list.txt")) << "nights/monday/a.mcap\n";
  EXPECT_THAT(names({}, folder_.file("list.txt")), ElementsAre("nights/monday/a"));
  touch("nights/tuesday/a.mcap");
  EXPECT_THAT(names({folder_.file("nights")}), ElementsAre("monday/a", "tuesday/a"));
}

TEST_F(Drives, AreFoundThroughLinks) {
  for (const char* name : {"nights/monday/a.mcap", "disk/b.mcap"}) touch(name);
  fs::create_directory_symlink(folder_.file("disk"), folder_.file("nights/disk"));
  fs::create_directory_symlink(folder_.file("nights/monday"), folder_.file("nights/latest"));
  fs::create_directory_symlink(folder_.file("nights"), folder_.file("nights/monday/up"));
  fs::create_symlink("itself.mcap", folder_.file("nights/itself.mcap"));
  fs::create_symlink("nowhere", folder_.file("nights/broken.mcap"));
  EXPECT_THAT(names({folder_.file("nights")}), ElementsAre("broken", "disk/b", "itself", "monday/a"));
}

TEST_F(Drives, OfOneNameAreRefused) {
  touch("a.mcap");
  touch("a.frames.jsonl");
  EXPECT_THAT([&] { names({folder_.file("*")}); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("would have one output")));
}

}  // namespace
}  // namespace laneloom::batch
