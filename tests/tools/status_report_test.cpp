#include "status/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/json_text.hpp"

namespace laneloom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

ServiceStatus degraded() {
  ServiceStatus status;
  status.session_id = 77;
  status.state = MapState::degraded;
  status.reasons = {StateReason::no_poses, StateReason::reset};
  status.uptime_s = 3725.2;
  status.detections_age_s = 0.05;
  status.pending_frames = 3;
  status.tick = {0.9, 0.6, 4.9, 6.0};
  status.counters = {{"frames_fused", 12}, {"poses_lost", 0}, {"poses_refused_late", 5}};
  status.sources = {
      {"front camera", 9, 100, 130, 31, 30, 0.1, {{"pitch_gain", 0.9}, {"stddev_at_8_m", 0.034}}}};
  status.version = "1.2.3";
  status.config_hash = "0123456789abcdef";
  return status;
}

TEST(StatusReport, TellsHowTheServiceIs) {
  const ServiceStatus status = degraded();
  const std::string text = status::describe(status, nullptr);
  EXPECT_THAT(text, HasSubstr("DEGRADED no_poses reset\n"));
  EXPECT_THAT(text,
              HasSubstr("version 1.2.3   up 1:02:05\nsession         77   configuration 0123456789abcdef"));
  EXPECT_THAT(text, HasSubstr("detections      0.05 s ago"));
  EXPECT_THAT(text, HasSubstr("poses           never"));
  EXPECT_THAT(text, HasSubstr("pending frames  3"));
  EXPECT_THAT(text, HasSubstr("mean 0.90  p50 0.60  p99 4.90  max 6.00 ms"));
  EXPECT_THAT(text, HasSubstr("\"front camera\": 31 frames, 100 to 130, session 9"));
  EXPECT_THAT(text, HasSubstr("lateral deviation      0.03 m at 8"));
  EXPECT_THAT(text, HasSubstr("believed of pitch      0.90 of"));
  EXPECT_THAT(text, Not(HasSubstr("lanelines seen"))) << "it is not told";
  EXPECT_THAT(text, HasSubstr("poses_refused_late"));
  EXPECT_THAT(text, Not(HasSubstr("poses_lost"))) << "it is zero";
  EXPECT_THAT(text, Not(HasSubstr("+")));
}

TEST(StatusReport, NamesOfAnyTextAreJson) {
  const std::string name = "a \"quoted\\ näme\n";
  ServiceStatus status = degraded();
  status.sources[0].source = name;
  status.sources[0].learned = {{"beside_" + name, 0.5}, {"no \xff text", 0.25}};
  const auto read = nlohmann::json::parse(io::json_text(status::to_json(status, nullptr)));
  const auto& source = read.at("sources").at(0);
  EXPECT_EQ(source.at("source"), name);
  EXPECT_EQ(source.at("learned").at("beside_" + name), 0.5);
  EXPECT_EQ(source.at("learned").at("no \uFFFD text"), 0.25);
}

TEST(StatusReport, TellsWhatRose) {
  const ServiceStatus before = degraded();
  ServiceStatus now = before;
  now.counters = {{"frames_fused", 12}, {"poses_lost", 1}, {"poses_refused_late", 9}, {"ticks_missed", 2}};
  EXPECT_THAT(status::rises(now, before),
              ElementsAre(Pair("poses_lost", 1), Pair("poses_refused_late", 4), Pair("ticks_missed", 2)));
  EXPECT_THAT(status::describe(now, &before), HasSubstr("9  +4\n"));
  EXPECT_EQ(status::to_json(now, &before).at("rises").at("poses_refused_late"), 4);
}

TEST(StatusReport, IsReadByMachines) {
  const nlohmann::json json = status::to_json(degraded(), nullptr);
  EXPECT_EQ(json.at("state"), "DEGRADED");
  EXPECT_EQ(json.at("reasons"), (nlohmann::json{"no_poses", "reset"}));
  EXPECT_EQ(json.at("detections_age_s"), 0.05);
  EXPECT_TRUE(json.at("poses_age_s").is_null());
  EXPECT_EQ(json.at("tick_ms").at("p99"), 4.9);
  EXPECT_EQ(json.at("counters").at("poses_lost"), 0);
  EXPECT_EQ(json.at("sources").at(0).at("last_sequence"), 130);
  EXPECT_TRUE(json.at("rises").is_null());
}

TEST(StatusReport, KeepsWhatOthersWriteFromTheTerminal) {
  ServiceStatus status = degraded();
  status.sources[0].source = "\x1b[2Jcamera";
  EXPECT_THAT(status::describe(status, nullptr), HasSubstr("\"?[2Jcamera\""));
}

}  // namespace
}  // namespace laneloom
