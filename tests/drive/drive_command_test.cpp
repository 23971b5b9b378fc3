#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "own_domain.hpp"
#include "support/child_process.hpp"
#include "temporary_folder.hpp"

namespace laneloom::drive {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Runs the real `laneloom-lab drive`.
class DriveCommand : public testing::Test {
 protected:
  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {LANELOOM_LAB, "drive"});
    return support::ChildProcess(arguments, file_).wait();
  }
  std::string output() const { return content(file_); }

  const TemporaryFolder folder_;
  const std::string file_ = folder_.file("output");
};

TEST_F(DriveCommand, DrivesSeveralRoadsAndSeeds) {
  ASSERT_EQ(run({"--scenario", "straight", "--scenario", "hill", "--seeds", "1,2", "--noise", "none", "--km",
                 "0.2", "--json", "--require-lane"}),
            0)
      << output();
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
  const std::string config = folder_.file("laneloom.yaml");
  std::ofstream(config) << "mapper:\n  lane:\n    min_width_m: 1.0\n    max_width_m: 1.5\n    "
                           "max_kerb_width_m: 1.5\n    one_sided_lanes: false\n";
  const std::vector<std::string> words{"--scenario", "overpass", "--duration", "200", "--config", config};
  EXPECT_EQ(run(words), 0) << output();
  EXPECT_THAT(output(), HasSubstr("overpass, seed 1: "));
  std::vector<std::string> strict = words;
  strict.emplace_back("--require-lane");
  EXPECT_EQ(run(strict), 2);
}

TEST_F(DriveCommand, WrongInputIsNamed) {
  EXPECT_NE(run({}), 0);
  EXPECT_NE(run({"--scenario", "nowhere"}), 0);
  EXPECT_NE(run({"--scenario", "hill", "--noise", "loud"}), 0);
  EXPECT_NE(run({"--scenario", "hill", "--km", "-1"}), 0);
  EXPECT_NE(run({"--scenario", "hill", "--km", "1", "--duration", "5"}), 0);
  EXPECT_NE(run({"--scenario", "hill", "--dds", "--preset", "av2"}), 0);
  EXPECT_NE(run({"--scenario", "hill", "--duration", "1", "--vehicle-id", "mine"}), 0) << "without --dds";
  EXPECT_THAT(output(), HasSubstr("--dds"));
  EXPECT_EQ(run({"--lanelet2", LANELOOM_LAB}), 1);
  EXPECT_THAT(output(), HasSubstr(LANELOOM_LAB));
  EXPECT_EQ(run({"--scenario", "hill", "--scenario", "curve", "--dds"}), 1);
  EXPECT_THAT(output(), HasSubstr("one road"));
}

TEST_F(DriveCommand, DrivesOnTheMapOfARunningService) {
  const std::string domain = std::to_string(own_domain());
  const std::string log = folder_.file("log");
  const support::ChildProcess service({LANELOOM_SERVICE, "--domain", domain, "--vehicle-id", "test"}, log);
  ASSERT_EQ(run({"--scenario", "straight", "--noise", "none", "--duration", "10", "--dds", "--domain", domain,
                 "--vehicle-id", "test", "--json", "--require-lane"}),
            0)
      << output() << content(log);
  const json all = json::parse(output()).at("all");
  EXPECT_GT(all.at("driven_m"), 10.0);
  EXPECT_LT(all.at("standing_s"), 6.0);
}

TEST_F(DriveCommand, SaysThatNoServiceIsThere) {
  const std::string domain = std::to_string(own_domain());
  EXPECT_EQ(run({"--scenario", "straight", "--dds", "--domain", domain, "--vehicle-id", "nobody"}), 3);
  EXPECT_THAT(output(), HasSubstr("no service"));
}

}  // namespace
}  // namespace laneloom::drive
