#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "commands.hpp"

// No command loses a file that it is given.
namespace laneloom {
namespace {

using testing::HasSubstr;

class GivenFiles : public Commands {
 protected:
  void SetUp() override { simulate("none", "in.frames.jsonl"); }

  void refuses(const std::string& words, const std::string& output_file, const std::string& why) const {
    EXPECT_EQ(run(words), 1) << words << output();
    EXPECT_THAT(output(), HasSubstr(output_file + ": is " + why)) << words;
  }
};

TEST_F(GivenFiles, NoInputIsWrittenOver) {
  ASSERT_TRUE(done("replay in.frames.jsonl --out map.jsonl"));
  ASSERT_TRUE(done("cut in.frames.jsonl --out in.mcap"));
  ASSERT_TRUE(done("export in.frames.jsonl --opendrive road.xodr"));
  std::string before;
  for (const char* name : {"in.frames.jsonl", "in.mcap", "map.jsonl", "truth.json", "road.xodr"})
    before += text(name);
  refuses("learn in.frames.jsonl --out in.frames.jsonl", "in.frames.jsonl", "an input");
  refuses("check in.frames.jsonl --out ./in.frames.jsonl", "./in.frames.jsonl", "an input");
  refuses("evaluate --later --in in.frames.jsonl --json in.frames.jsonl", "in.frames.jsonl", "an input");
  const std::string evaluate = "evaluate --truth truth.json --frames in.frames.jsonl --map map.jsonl --json ";
  for (const std::string input : {"truth.json", "in.frames.jsonl", "map.jsonl"})
    refuses(evaluate + input, input, "an input");
  refuses("simulate --opendrive road.xodr --frames road.xodr", "road.xodr", "an input");
  refuses("publish --opendrive road.xodr --truth road.xodr", "road.xodr", "an input");
  refuses("export in.frames.jsonl map.jsonl --lanelet2 map.jsonl", "map.jsonl", "an input");
  refuses("import frames in.mcap --out in", "in.mcap", "an input");
  refuses("import scene in.mcap --out in.mcap", "in.mcap", "an input");
  std::string after;
  for (const char* name : {"in.frames.jsonl", "in.mcap", "map.jsonl", "truth.json", "road.xodr"})
    after += text(name);
  EXPECT_EQ(before, after);
}

TEST_F(GivenFiles, NoOutputIsWrittenOverAnotherOne) {
  refuses("simulate --scenario straight --frames s --truth ./s", "./s", "given as an output twice");
  refuses("export in.frames.jsonl --lanelet2 x.osm --opendrive ./x.osm", "./x.osm",
          "given as an output twice");
  refuses("export in.frames.jsonl --lanelet2 x.osm --report x.osm", "x.osm", "given as an output twice");
  EXPECT_FALSE(exists("s"));
  EXPECT_FALSE(exists("x.osm"));
}

TEST_F(GivenFiles, StandardInputIsReadOnce) {
  const auto refused = [&](const std::string& words, const std::string& why) {
    EXPECT_EQ(run(words + " <in.frames.jsonl"), 1) << words << output();
    EXPECT_THAT(output(), HasSubstr("-: standard input can be read once, and " + why)) << words;
  };
  refused("replay - --config $CONFIG/laneloom.yaml --config $CONFIG/paper.yaml", "a second --config reads");
  refused("evaluate --truth truth.json -", "--truth reads it twice");
  refused("evaluate --truth truth.json --frames -", "--truth reads it twice");
  refused("evaluate --later --frames - --map -", "is given twice");
  refused("learn - --sensor-left --out profile.yaml", "--sensor-left reads it twice");
  refused("export - - --lanelet2 a.osm", "is given twice");
  refused("render --frames - --map - --out a.svg", "is given twice");
  EXPECT_TRUE(done("evaluate --later - <in.frames.jsonl"));
  EXPECT_TRUE(done("learn - --out profile.yaml <in.frames.jsonl"));
}

TEST_F(GivenFiles, StandardOutputIsOneFileWithoutTheReport) {
  ASSERT_TRUE(done("check in.frames.jsonl --out - 2>report"));
  EXPECT_TRUE(json_of("output").contains("findings"));
  EXPECT_THAT(text("report"), HasSubstr("in.frames.jsonl"));
  EXPECT_EQ(run("publish --scenario straight --frames - --truth -"), 64);
  EXPECT_THAT(output(), HasSubstr("standard output is another file already"));
}

TEST_F(GivenFiles, AnOutputIsOpenedOnlyWhenItCanBeWritten) {
  ASSERT_TRUE(done("cut in.frames.jsonl --out in.mcap"));
  ASSERT_EQ(shell("echo kept >keep.jsonl"), 0);
  EXPECT_EQ(run("cut in.mcap --topic detections --out keep.jsonl"), 1);
  EXPECT_THAT(output(), HasSubstr("JSON lines hold frames with their poses"));
  EXPECT_EQ(text("keep.jsonl"), "kept\n");
}

}  // namespace
}  // namespace laneloom
