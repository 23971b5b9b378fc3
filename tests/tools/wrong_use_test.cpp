#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "commands.hpp"

// The commands name the word, file or number that is wrong.
namespace laneloom {
namespace {

using testing::HasSubstr;

TEST_F(Commands, ACommandThatThereIsNotIsNamedWithTheNearest) {
  EXPECT_EQ(run("frobnicate"), 64);
  EXPECT_THAT(output(), HasSubstr("there is no command 'frobnicate'; the nearest is"));
  EXPECT_EQ(run("evalute --truth x"), 64);
  EXPECT_THAT(output(), HasSubstr("there is no command 'evalute'; the nearest is 'evaluate'"));
  EXPECT_EQ(run("import argoverse"), 64);
  EXPECT_THAT(output(), HasSubstr("there is no command 'argoverse'; the nearest is 'argoverse2'"));
}

TEST_F(Commands, ACommandOfTheOtherProgramIsNamedWithIt) {
  EXPECT_EQ(run("drive --scenario hill"), 64);
  EXPECT_THAT(output(), HasSubstr("'drive' is a command of laneloom-lab: laneloom-lab drive"));
  EXPECT_EQ(run_lab("replay --in x"), 64);
  EXPECT_THAT(output(), HasSubstr("'replay' is a command of laneloom: laneloom replay"));
  for (const std::string command : {"export", "view"}) {
    EXPECT_EQ(run_lab(command), 64);
    EXPECT_THAT(output(), HasSubstr("is a command of laneloom: laneloom " + command));
  }
}

TEST_F(Commands, WrongUseHasOneExitCode) {
  EXPECT_EQ(run(""), 64);
  EXPECT_EQ(run("--nonsense"), 64);
  EXPECT_EQ(run("replay"), 64) << "an option is missing";
  EXPECT_EQ(run("pnc --duration soon"), 64);
  EXPECT_EQ(run("simulate --scenario nowhere --frames x"), 64);
  EXPECT_TRUE(done("import --help"));
  EXPECT_TRUE(done("--help"));
  EXPECT_THAT(output(), HasSubstr("Exit codes: 0 done; 1 it failed;"));
}

TEST_F(Commands, WrongUseIsToldWithTheUsageOfTheCommand) {
  EXPECT_EQ(run("replay"), 64);
  EXPECT_THAT(output(), HasSubstr("laneloom replay: --in is required\nUsage: laneloom replay"));
  EXPECT_EQ(run("import maptr --nonsense"), 64);
  EXPECT_THAT(output(), HasSubstr("Usage: laneloom import maptr"));
  EXPECT_THAT(output(), HasSubstr("`laneloom import maptr --help` tells more."));
  EXPECT_EQ(run_lab("bench --nonsense"), 64);
  EXPECT_THAT(output(), HasSubstr("Usage: laneloom-lab bench"));
}

TEST_F(Commands, HelpIsACommand) {
  EXPECT_TRUE(done("--help"));
  const std::string help = output();
  EXPECT_TRUE(done("help"));
  EXPECT_EQ(output(), help);
  EXPECT_TRUE(done("help import maptr"));
  EXPECT_THAT(output(), HasSubstr("laneloom import maptr [OPTIONS]"));
}

TEST_F(Commands, AFileNeedsNoOption) {
  simulate("none", "in.frames.jsonl");
  ASSERT_TRUE(done("replay --in in.frames.jsonl --out a.jsonl"));
  ASSERT_TRUE(done("replay in.frames.jsonl --out b.jsonl"));
  EXPECT_EQ(text("a.jsonl"), text("b.jsonl"));
  EXPECT_TRUE(done("check in.frames.jsonl"));
}

TEST_F(Commands, FramesMayComeFromStandardInput) {
  simulate("none", "in.frames.jsonl");
  ASSERT_TRUE(done("replay in.frames.jsonl --out a.jsonl"));
  ASSERT_TRUE(done("replay - --out b.jsonl <in.frames.jsonl"));
  EXPECT_EQ(text("a.jsonl"), text("b.jsonl"));
}

TEST_F(Commands, AFileThatIsNotThereIsAFailureOfEveryCommand) {
  for (const std::string words :
       {"replay --in absent", "render --map absent --out x.svg", "evaluate --truth absent --map absent",
        "simulate --argoverse2 absent --frames x", "simulate --lanelet2 absent --frames x",
        "import argoverse2 absent --out x"}) {
    EXPECT_EQ(run(words), 1) << words << output();
    EXPECT_THAT(output(), HasSubstr("absent")) << words;
  }
}

TEST_F(Commands, AFileThatIsNotThereIsAFailureOfTheLaboratoryToo) {
  for (const std::string words :
       {"experiment --argoverse2 absent", "drive --scenario hill --config absent", "bench --config absent",
        "bench --duration 5 --peer absent", "bench latency --identities absent",
        "experiment --scenario hill --duration 5 --config default --peer absent"}) {
    EXPECT_EQ(run_lab(words), 1) << words << output();
    EXPECT_THAT(output(), HasSubstr("absent")) << words;
  }
}

TEST_F(Commands, WordsAndNumbersOfTheLaboratoryAreChecked) {
  EXPECT_EQ(run_lab("bench worse"), 64);
  for (const std::string number : {"nan", "1e18"}) {
    EXPECT_EQ(run_lab("drive --scenario hill --km " + number), 64);
    EXPECT_THAT(output(), HasSubstr("--km"));
  }
}

TEST_F(Commands, WrongInputIsNamed) {
  std::ofstream(file("broken.jsonl")) << "\n{\"t\": 1}\n";
  EXPECT_EQ(run("replay --in broken.jsonl"), 1);
  EXPECT_THAT(output(),
              HasSubstr("broken.jsonl: nothing of it can be read: 1 x pose: is missing (first: line 2)"));
  EXPECT_EQ(run("evaluate --truth broken.jsonl --map broken.jsonl"), 1);
  EXPECT_NE(run("simulate --frames x"), 0);
  EXPECT_NE(run("render --truth broken.jsonl --out x.png"), 0);
}

TEST_F(Commands, NumbersThatAreNoneOrFarTooLargeAreRefused) {
  simulate("none", "in.frames.jsonl");
  for (const std::string number : {"nan", "1e18"}) {
    const auto refused = [&](const std::string& words, const std::string& option) {
      EXPECT_GT(run(words + " " + option + " " + number), 0) << words << option << number;
      EXPECT_THAT(output(), HasSubstr(option)) << words << option << number;
    };
    refused("simulate --scenario hill --frames x.jsonl", "--duration");
    EXPECT_FALSE(exists("x.jsonl"));
    refused("publish --scenario hill --loop", "--duration");
    refused("publish --scenario hill", "--speed-up");
    refused("publish --scenario hill", "--from");
    refused("record --duration 0.1 --out x.mcap", "--max-size");
    refused("evaluate --truth truth.json --frames in.frames.jsonl", "--min-confidence");
    refused("render --truth truth.json --out x.svg", "--at");
  }
  EXPECT_EQ(run("render --truth truth.json --out x.svg --at -1"), 1);
}

TEST_F(Commands, OutputThatCannotBeWrittenIsAFailure) {
  simulate("none", "in.frames.jsonl");
  for (const std::string words : {"publish --list", "--version", "pnc --help",
                                  "evaluate --truth truth.json --frames in.frames.jsonl"}) {
    EXPECT_EQ(run(words + " >/dev/full 2>errors"), 1) << words;
    EXPECT_THAT(text("errors"), HasSubstr("standard output cannot be written")) << words;
  }
}

}  // namespace
}  // namespace laneloom
