#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tools/commands.hpp"

// The commands name the word, file or number that is wrong.
namespace laneloom {
namespace {

using testing::HasSubstr;

TEST_F(Commands, ACommandThatThereIsNotIsNamedWithTheNearest) {
  EXPECT_EQ(run({"frobnicate"}), 64);
  EXPECT_THAT(output(), HasSubstr("there is no command 'frobnicate'; the nearest is"));
  EXPECT_EQ(run({"evalute", "--truth", "x"}), 64);
  EXPECT_THAT(output(), HasSubstr("there is no command 'evalute'; the nearest is 'evaluate'"));
  EXPECT_EQ(run({"import", "argoverse"}), 64);
  EXPECT_THAT(output(), HasSubstr("there is no command 'argoverse'; the nearest is 'argoverse2'"));
}

TEST_F(Commands, ACommandOfTheOtherProgramIsNamedWithIt) {
  EXPECT_EQ(run({"drive", "--scenario", "hill"}), 64);
  EXPECT_THAT(output(), HasSubstr("'drive' is a command of laneloom-lab: laneloom-lab drive"));
  EXPECT_EQ(run_lab({"replay", "--in", "x"}), 64);
  EXPECT_THAT(output(), HasSubstr("'replay' is a command of laneloom: laneloom replay"));
  for (const std::string command : {"export", "view"}) {
    EXPECT_EQ(run_lab({command}), 64);
    EXPECT_THAT(output(), HasSubstr("is a command of laneloom: laneloom " + command));
  }
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

TEST_F(Commands, WrongUseIsToldWithTheUsageOfTheCommand) {
  EXPECT_EQ(run({"replay"}), 64);
  EXPECT_THAT(output(), HasSubstr("laneloom replay: --in is required\nUsage: laneloom replay"));
  EXPECT_EQ(run({"import", "maptr", "--nonsense"}), 64);
  EXPECT_THAT(output(), HasSubstr("Usage: laneloom import maptr"));
  EXPECT_THAT(output(), HasSubstr("`laneloom import maptr --help` tells more."));
  EXPECT_EQ(run_lab({"bench", "--nonsense"}), 64);
  EXPECT_THAT(output(), HasSubstr("Usage: laneloom-lab bench"));
}

TEST_F(Commands, HelpIsACommand) {
  EXPECT_EQ(run({"--help"}), 0);
  const std::string help = output();
  EXPECT_EQ(run({"help"}), 0);
  EXPECT_EQ(output(), help);
  EXPECT_EQ(run({"help", "import", "maptr"}), 0);
  EXPECT_THAT(output(), HasSubstr("laneloom import maptr [OPTIONS]"));
}

TEST_F(Commands, AFileNeedsNoOption) {
  simulate("none", "in.frames.jsonl");
  ASSERT_EQ(run({"replay", "--in", file("in.frames.jsonl"), "--out", file("a.jsonl")}), 0) << output();
  ASSERT_EQ(run({"replay", file("in.frames.jsonl"), "--out", file("b.jsonl")}), 0) << output();
  EXPECT_EQ(content(file("a.jsonl")), content(file("b.jsonl")));
  EXPECT_EQ(run({"check", file("in.frames.jsonl")}), 0) << output();
}

TEST_F(Commands, FramesMayComeFromStandardInput) {
  simulate("none", "in.frames.jsonl");
  ASSERT_EQ(run({"replay", file("in.frames.jsonl"), "--out", file("a.jsonl")}), 0) << output();
  const std::string command = std::string(LANELOOM_COMMAND) + " replay - --out " + file("b.jsonl") + " < " +
                              file("in.frames.jsonl") + " >/dev/null";
  ASSERT_EQ(support::ChildProcess({"/bin/sh", "-c", command}, file("output")).wait(), 0);
  EXPECT_EQ(content(file("a.jsonl")), content(file("b.jsonl")));
}

TEST_F(Commands, AFileThatIsNotThereIsAFailureOfEveryCommand) {
  const std::string absent = file("absent");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"replay", "--in", absent},
                                                {"render", "--map", absent, "--out", file("x.svg")},
                                                {"evaluate", "--truth", absent, "--map", absent},
                                                {"simulate", "--argoverse2", absent, "--frames", file("x")},
                                                {"simulate", "--lanelet2", absent, "--frames", file("x")},
                                                {"import", "argoverse2", absent, "--out", file("x")}}) {
    EXPECT_EQ(run(words), 1) << words.front() << output();
    EXPECT_THAT(output(), HasSubstr(absent)) << words.front();
  }
}

TEST_F(Commands, AFileThatIsNotThereIsAFailureOfTheLaboratoryToo) {
  const std::string absent = file("absent");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"experiment", "--argoverse2", absent},
        {"drive", "--scenario", "hill", "--config", absent},
        {"bench", "--config", absent},
        {"bench", "--duration", "5", "--peer", absent},
        {"bench", "latency", "--identities", absent},
        {"experiment", "--scenario", "hill", "--duration", "5", "--config", "default", "--peer", absent}}) {
    EXPECT_EQ(run_lab(words), 1) << words.front() << output();
    EXPECT_THAT(output(), HasSubstr(absent)) << words.front();
  }
}

TEST_F(Commands, WordsAndNumbersOfTheLaboratoryAreChecked) {
  EXPECT_EQ(run_lab({"bench", "worse"}), 64);
  for (const char* number : {"nan", "1e18"}) {
    EXPECT_EQ(run_lab({"drive", "--scenario", "hill", "--km", number}), 64);
    EXPECT_THAT(output(), HasSubstr("--km"));
  }
}

TEST_F(Commands, WrongInputIsNamed) {
  EXPECT_EQ(run({"replay", "--in", file("missing.jsonl")}), 1);
  EXPECT_THAT(output(), HasSubstr("missing.jsonl"));
  std::ofstream(file("broken.jsonl")) << "\n{\"t\": 1}\n";
  EXPECT_EQ(run({"replay", "--in", file("broken.jsonl")}), 1);
  EXPECT_THAT(output(),
              HasSubstr("broken.jsonl: nothing of it can be read: 1 x pose: is missing (first: line 2)"));
  EXPECT_EQ(run({"evaluate", "--truth", file("broken.jsonl"), "--map", file("broken.jsonl")}), 1);
  EXPECT_NE(run({"simulate", "--scenario", "nowhere", "--frames", file("x")}), 0);
  EXPECT_NE(run({"simulate", "--frames", file("x")}), 0);
  EXPECT_NE(run({"render", "--truth", file("broken.jsonl"), "--out", file("x.png")}), 0);
  EXPECT_NE(run({}), 0);
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
    refused({"publish", "--scenario", "hill", "--from", number});
    refused({"record", "--duration", "0.1", "--out", file("x.mcap"), "--max-size", number});
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
       {std::string("publish --list"), std::string("--version"), std::string("pnc --help"),
        "evaluate --truth " + file("truth.json") + " --frames " + file("in.frames.jsonl")}) {
    const std::string line = command + " " + words + " >/dev/full 2>" + file("errors");
    EXPECT_EQ(support::ChildProcess({"/bin/sh", "-c", line}, file("output")).wait(), 1) << words;
    EXPECT_THAT(content(file("errors")), HasSubstr("standard output cannot be written")) << words;
  }
}

}  // namespace
}  // namespace laneloom
