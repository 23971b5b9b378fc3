#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "commands.hpp"
#include "config/config_file.hpp"
#include "recording/recording.hpp"

namespace laneloom {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST_F(Commands, InfoTellsWhatIsInADrive) {
  simulate("none", "in.frames.jsonl");
  EXPECT_TRUE(done("info in.frames.jsonl"));
  EXPECT_THAT(output(), HasSubstr("laneloom/v"));
  ASSERT_TRUE(done("info --json in.frames.jsonl"));
  const json info = json::parse(output());
  EXPECT_EQ(info.at("version"), "") << "JSON lines do not tell";
  ASSERT_EQ(info.at("topics").size(), 2u);
  for (const json& topic : info.at("topics")) {
    EXPECT_EQ(topic.at("messages"), 80);
    EXPECT_NEAR(topic.at("rate_hz"), 10.0, 0.01);
    EXPECT_NEAR(topic.at("longest_gap_s"), 0.1, 1e-6);
  }
}

TEST_F(Commands, ARecordingOfMapsCarriesTheConfigurationThatMadeThem) {
  simulate("none", "in.frames.jsonl");
  std::ofstream(file("mine.yaml")) << "mapper: {lane: {min_width_m: 1.7}}\n";
  ASSERT_TRUE(done("replay in.frames.jsonl --config mine.yaml --out a.mcap"));
  ASSERT_TRUE(done("info --json a.mcap"));
  EXPECT_NE(json::parse(output()).at("version"), "");

  ASSERT_TRUE(done("info --configuration a.mcap"));
  std::ofstream(file("theirs.yaml")) << output();
  ASSERT_TRUE(done("replay in.frames.jsonl --config theirs.yaml --out b.mcap"));
  EXPECT_EQ(text("a.mcap"), text("b.mcap"));
}

TEST_F(Commands, ARecordingOfAServiceTellsTheConfigurationOfTheService) {
  Config config;
  config.mapper.range.forward_max_m = 42.0;
  config.mapper.lane.min_width_m = 1.7;
  config.dds.vehicle_id = "car_7";
  config.service.snapshot_file = "/var/lib/a: b, c";
  config.dds.profile_file = "profiles.xml";  // valid with the next alone
  config.dds.profile_name = "car";
  recording::RecordingWriter out(file("live.mcap"));
  out.write(ServiceStatus{.published_ns = 5, .configuration = config::settings(config)}, 5);
  out.close();
  ASSERT_TRUE(done("info --configuration live.mcap"));
  std::ofstream(file("theirs.yaml")) << output();
  EXPECT_EQ(config::config_hash(config::load_config(file("theirs.yaml"))), config::config_hash(config));

  recording::RecordingWriter other(file("other.mcap"));
  other.write(ServiceStatus{.published_ns = 5, .configuration = {{"mapper.unheard_of", "1"}}}, 5);
  other.close();
  EXPECT_EQ(run("info --configuration other.mcap"), 1);
  EXPECT_THAT(output(), HasSubstr("other.mcap: the service's configuration: mapper.unheard_of: is not a"));
}

TEST_F(Commands, ADriveOfNobodysConfigurationSaysSo) {
  simulate("none", "in.frames.jsonl");
  ASSERT_TRUE(done("cut in.frames.jsonl --out in.mcap"));
  for (const std::string drive : {"in.frames.jsonl", "in.mcap"}) {
    EXPECT_EQ(run("info --configuration " + drive), 1);
    EXPECT_THAT(output(), HasSubstr(drive + ": nobody tells its configuration"));
  }
}

}  // namespace
}  // namespace laneloom
