#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "own_domain.hpp"

namespace laneloom::drive {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class DriveCommand : public Commands {
 protected:
  int run(const std::string& words) const override { return run_lab("drive " + words); }

  const std::string dds_ = " --domain " + std::to_string(own_domain()) + " --vehicle-id ";
};

TEST_F(DriveCommand, DrivesSeveralRoadsAndSeeds) {
  ASSERT_TRUE(
      done("--scenario straight --scenario hill --seeds 1,2 --noise none --km 0.2 --json --require-lane"));
  const json result = json::parse(output());
  ASSERT_EQ(result.at("drives").size(), 4U);
  EXPECT_EQ(result.at("drives")[2].at("road"), "hill");
  EXPECT_EQ(result.at("drives")[3].at("seed"), 2);
  EXPECT_NEAR(result.at("drives")[0].at("driven_m"), 200.0, 1.0);
  EXPECT_NEAR(result.at("all").at("driven_m"), 800.0, 4.0);
  EXPECT_LT(result.at("all").at("lateral_error_m").at("max"), 0.2);
}

TEST_F(DriveCommand, FailsOnRequestWhenTheLaneIsLeft) {
  // Lanes of this width are none for the map, and straight on leads out of the bend.
  std::ofstream(file("narrow.yaml")) << "mapper: {lane: {min_width_m: 1.0, max_width_m: 1.5, "
                                        "max_kerb_width_m: 1.5, one_sided_lanes: false}}";
  const std::string words = "--scenario overpass --duration 200 --config narrow.yaml";
  EXPECT_TRUE(done(words));
  EXPECT_THAT(output(), HasSubstr("overpass, seed 1: "));
  EXPECT_EQ(run(words + " --require-lane"), 2);
}

TEST_F(DriveCommand, WrongInputIsNamed) {
  EXPECT_NE(run(""), 0);
  EXPECT_NE(run("--scenario nowhere"), 0);
  EXPECT_NE(run("--scenario hill --noise loud"), 0);
  EXPECT_NE(run("--scenario hill --km -1"), 0);
  EXPECT_NE(run("--scenario hill --km 1 --duration 5"), 0);
  EXPECT_NE(run("--scenario hill --dds --preset av2"), 0);
  EXPECT_NE(run("--scenario hill --duration 1 --vehicle-id mine"), 0) << "without --dds";
  EXPECT_THAT(output(), HasSubstr("--dds"));
  EXPECT_EQ(run("--lanelet2 /bin/sh"), 1);
  EXPECT_THAT(output(), HasSubstr("/bin/sh"));
  EXPECT_EQ(run("--scenario hill --scenario curve --dds"), 1);
  EXPECT_THAT(output(), HasSubstr("one road"));
}

TEST_F(DriveCommand, DrivesOnTheMapOfARunningService) {
  const support::ChildProcess service = start("laneloomd" + dds_ + "test", "log");
  ASSERT_TRUE(
      done("--scenario straight --noise none --duration 10 --dds --json --require-lane" + dds_ + "test"))
      << text("log");
  const json all = json::parse(output()).at("all");
  EXPECT_GT(all.at("driven_m"), 10.0);
  EXPECT_LT(all.at("standing_s"), 6.0);
}

TEST_F(DriveCommand, FollowsTheWayOfARunningServiceThatIsToldTheTurn) {
  const support::ChildProcess service = start("laneloomd" + dds_ + "turns", "log");
  ASSERT_TRUE(
      done("--scenario intersection --noise none --duration 30 --dds --published-way --json "
           "--require-lane" +
           dds_ + "turns"))
      << text("log");
  const json all = json::parse(output()).at("all");
  EXPECT_GT(all.at("driven_m"), 100.0) << "beyond the intersection";
  EXPECT_EQ(all.at("missed_turns"), 0);
}

TEST_F(DriveCommand, SaysThatNoServiceIsThere) {
  EXPECT_EQ(run("--scenario straight --dds" + dds_ + "nobody"), 3);
  EXPECT_THAT(output(), HasSubstr("no service"));
}

}  // namespace
}  // namespace laneloom::drive
