#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <vector>

#include "commands.hpp"
#include "io/json_lines.hpp"

namespace laneloom {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The programs as processes, on a drive of half a minute with a bend.
class CheckCommand : public Commands {
 protected:
  void SetUp() override {
    ASSERT_TRUE(done("simulate --scenario curve --noise inhouse --frames drive.frames.jsonl"));
  }

  /// Writes the drive anew.
  void spoil(const std::function<void(io::FrameRecord&)>& change) const {
    io::JsonLinesReader in(file("drive.frames.jsonl"));
    io::JsonLinesWriter out(file("spoilt.frames.jsonl"));
    while (auto record = in.next_frame()) {
      change(*record);
      out.write(*record);
    }
    out.close();
  }
  void mirror() const {
    spoil([](io::FrameRecord& record) {
      for (Detection& detection : record.frame.detections)
        for (Point& point : detection.points) point.y() = -point.y();
      for (Point& point : record.frame.field_of_view) point.y() = -point.y();
    });
  }
};

TEST_F(CheckCommand, ASoundDriveIsSound) {
  EXPECT_TRUE(done("check drive.frames.jsonl"));
  EXPECT_THAT(output(), HasSubstr("nothing wrong was found"));
  EXPECT_TRUE(done("check --json drive.frames.jsonl"));
  EXPECT_TRUE(json::parse(output()).at("findings").empty()) << output();
}

TEST_F(CheckCommand, ADriveOfWhichLittleCanBeReadIsNotSound) {
  const std::string whole = text("drive.frames.jsonl");
  const std::size_t rest = whole.find('\n', whole.size() / 2) + 1;
  std::ofstream damaged(file("damaged.frames.jsonl"));
  damaged << whole.substr(0, rest);
  for (int i = 0; i < 100; ++i) damaged << "{}\n";
  damaged.close();
  EXPECT_EQ(run("check --json damaged.frames.jsonl 2>log"), 2);
  EXPECT_EQ(json::parse(output()).at("findings").at(0).at("id"), "left_out");
}

TEST_F(CheckCommand, ATerminalShowsABar) {
  EXPECT_EQ(shell("script -qec 'laneloom check drive.frames.jsonl' /dev/null"), 0);
  EXPECT_THAT(output(), HasSubstr(" left"));
}

TEST_F(CheckCommand, AnOffsetThatIsLearnedMovesThePoints) {
  spoil([](io::FrameRecord& record) {
    record.frame.source = "front";
    for (Detection& detection : record.frame.detections)
      for (Point& point : detection.points) point.y() -= 0.6;
  });
  ASSERT_TRUE(done("learn --sensor-left spoilt.frames.jsonl --out network.yaml"));
  EXPECT_THAT(text("network.yaml"), HasSubstr("sensor_left_m"));
  std::ofstream(file("c.yaml")) << "mapper: {fusion: {profile_file: '" << file("network.yaml") << "'}}";
  const auto own_middle_m = [&](const std::string& options) {
    EXPECT_TRUE(done("replay spoilt.frames.jsonl --out maps.jsonl " + options));
    io::JsonLinesReader maps(file("maps.jsonl"));
    std::vector<double> middles_m;
    while (const auto map = maps.next_map())
      if (map->way && !map->way->stations.empty())
        middles_m.push_back((map->T_map_body.inverse() * map->way->stations.front().point).y());
    std::ranges::sort(middles_m);
    return middles_m.at(middles_m.size() / 2);
  };
  EXPECT_NEAR(own_middle_m(""), -0.6, 0.15);
  EXPECT_NEAR(own_middle_m("--config c.yaml"), 0.0, 0.15);
  // What was learned with an offset keeps it.
  ASSERT_TRUE(done("learn spoilt.frames.jsonl --config c.yaml --out again.yaml"));
  EXPECT_THAT(text("again.yaml"), HasSubstr("sensor_left_m"));
}

TEST_F(CheckCommand, TheRemedyMendsTheDrive) {
  mirror();
  EXPECT_EQ(run("check --json spoilt.frames.jsonl"), 2) << output();
  const json finding = json::parse(output()).at("findings").at(0);
  EXPECT_EQ(finding.at("id"), "axes");
  EXPECT_THAT(finding.at("remedy"), HasSubstr("laneloom import frames --axes forward-right"));

  ASSERT_TRUE(done("import frames spoilt.frames.jsonl --axes forward-right --out mended.mcap"));
  EXPECT_TRUE(done("check mended.mcap"));
}

TEST_F(CheckCommand, ConfidencesOfAnotherScaleAreMended) {
  spoil([](io::FrameRecord& record) {
    for (Detection& detection : record.frame.detections) detection.confidence *= 100.0;
  });
  EXPECT_EQ(run("check spoilt.frames.jsonl"), 2) << output();
  EXPECT_THAT(output(), HasSubstr("--confidence percent"));
  ASSERT_TRUE(done("import frames spoilt.frames.jsonl --confidence percent --out mended.mcap"));
  EXPECT_TRUE(done("check mended.mcap"));
}

TEST_F(CheckCommand, PointsInTheMapFrameGetBackIntoTheBodyFrame) {
  spoil([](io::FrameRecord& record) {
    const Eigen::Isometry3d T_map_body = transform(record.pose);
    for (Detection& detection : record.frame.detections)
      for (Point& point : detection.points) point = T_map_body * point;
  });
  ASSERT_TRUE(done("import frames spoilt.frames.jsonl --points-in-map --out mended.mcap"));
  EXPECT_TRUE(done("check mended.mcap"));
}

TEST_F(CheckCommand, ReplayAndRatingTellWhyLittleCameOfIt) {
  spoil([](io::FrameRecord& record) {
    for (Detection& detection : record.frame.detections)
      for (Point& point : detection.points) point *= 1000.0;
  });
  EXPECT_TRUE(done("replay --in spoilt.frames.jsonl"));
  EXPECT_THAT(output(), HasSubstr("--point-scale 0.001"));
  EXPECT_EQ(run("evaluate --later --in spoilt.frames.jsonl"), 1);
  EXPECT_THAT(output(), HasSubstr("--point-scale 0.001"));

  EXPECT_TRUE(done("replay --in drive.frames.jsonl"));
  EXPECT_THAT(output(), testing::Not(HasSubstr("laneloom check")));
}

TEST_F(CheckCommand, WrongUseIsTold) {
  EXPECT_EQ(run("check none.mcap"), 1);
  EXPECT_THAT(output(), HasSubstr("none.mcap"));
  EXPECT_EQ(run("import frames drive.frames.jsonl --axes north-west --out x.mcap"), 64);
  EXPECT_THAT(output(), HasSubstr("north"));
}

}  // namespace
}  // namespace laneloom
