#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/json_lines.hpp"
#include "laneloom/dds/discovery.hpp"
#include "laneloom/dds/topics.hpp"
#include "own_domain.hpp"
#include "recording/recording.hpp"
#include "tools/commands.hpp"

// The commands and the service, as processes that meet over DDS.
namespace laneloom {
namespace {

using nlohmann::json;

/// Real processes over real DDS, in a domain of the test's own.
class Loopback : public Commands {
 protected:
  std::vector<std::string> command(std::vector<std::string> words) const {
    const std::string domain = std::to_string(own_domain());
    words.insert(words.end(), {"--domain", domain, "--vehicle-id", "test"});
    return words;
  }
  /// How often a process wrote this so far.
  int seen(const std::string& log, const std::string& event) const {
    const std::string text = content(file(log));
    int count = 0;
    for (auto at = text.find(event); at != std::string::npos; at = text.find(event, at + 1)) ++count;
    return count;
  }
  bool wait_for(const std::string& log, const std::string& event, int times) const {
    return eventually([&] { return seen(log, event) >= times; });
  }
  /// Whether it gets true within a minute, which only a busy host needs.
  static bool eventually(const std::function<bool()>& condition) {
    for (int i = 0; i < 1200 && !condition(); ++i) usleep(50'000);
    return condition();
  }

  static constexpr const char* kOk = "\"state\":\"OK\"";
};

TEST_F(Loopback, PncWithoutServiceSaysSo) { EXPECT_EQ(run(command({"pnc", "--duration", "0.5"})), 3); }

TEST_F(Loopback, ADriveBeginsWhereItIsTold) {
  ASSERT_EQ(
      run(command({"publish", "--scenario", "straight", "--duration", "0.3", "--frames", file("whole")})), 0);
  ASSERT_EQ(run(command({"publish", "--scenario", "straight", "--from", "5", "--duration", "0.3", "--frames",
                         file("later")})),
            0);
  io::JsonLinesReader whole(file("whole")), later(file("later"));
  const auto first = whole.next_frame(), moved = later.next_frame();
  ASSERT_TRUE(first && moved);
  EXPECT_NEAR((moved->pose.position - first->pose.position).norm(), 5.0 * 10.0, 0.1);
  EXPECT_EQ(run(command({"publish", "--scenario", "straight", "--loop", "--from", "1000"})), 1);
  EXPECT_THAT(output(), testing::HasSubstr("begin earlier"));
}

TEST_F(Loopback, LanesReachThePlanner) {
  support::ChildProcess service(command({LANELOOM_SERVICE}), file("service.log"));
  support::ChildProcess publisher(
      command({LANELOOM_COMMAND, "publish", "--scenario", "straight", "--loop", "--wait-for-readers", "1",
               "--frames", file("frames.jsonl"), "--truth", file("truth.json")}),
      file("publish.log"));
  support::ChildProcess planner(
      command({LANELOOM_COMMAND, "pnc", "--json", "--require-lanes", "--record", file("map.jsonl")}),
      file("pnc.log"));
  ASSERT_TRUE(wait_for("pnc.log", kOk, 100)) << content(file("pnc.log"));
  planner.signal(SIGTERM);
  EXPECT_EQ(planner.wait(), 0) << content(file("pnc.log")).substr(0, 4000) << content(file("service.log"));
  publisher.signal(SIGTERM);
  EXPECT_EQ(publisher.wait(), 0) << content(file("publish.log"));
  service.signal(SIGTERM);
  EXPECT_EQ(service.wait(), 0) << content(file("service.log"));

  ASSERT_EQ(run({"evaluate", "--truth", file("truth.json"), "--frames", file("frames.jsonl"), "--map",
                 file("map.jsonl"), "--json", file("score.json")}),
            0)
      << output();
  const json fused = json::parse(content(file("score.json"))).at("fused");
  EXPECT_GT(fused.at("frames"), 10);
  EXPECT_GT(fused.at("lane").at("precision"), 0.9);
}

/// A drive's recording, made while `driver` publishes it to a service.
class RecordedLoopback : public Loopback {
 protected:
  void record(std::vector<std::string> driver, const std::string& name) {
    support::ChildProcess service(command({LANELOOM_SERVICE}), file("service.log"));
    support::ChildProcess recorder(command({LANELOOM_COMMAND, "record", "--out", file(name)}),
                                   file("record.log"));
    ASSERT_TRUE(eventually([&] { return newest_map(file(name)).has_value(); }));
    driver.insert(driver.begin(), LANELOOM_COMMAND);
    driver.insert(driver.end(), {"--wait-for-readers", "2"});
    support::ChildProcess publisher(command(driver), file("publish.log"));
    ASSERT_EQ(publisher.wait(), 0) << content(file("publish.log"));
    ASSERT_TRUE(eventually([&] { return tells_of_the_end(*newest_map(file(name))); }));
    recorder.signal(SIGTERM);
    ASSERT_EQ(recorder.wait(), 0) << content(file("record.log"));
  }

 private:
  /// The newest map that is written; none: no map came yet. The service publishes maps before it gets any
  /// input.
  static std::optional<PublishedMap> newest_map(const std::string& recording) {
    std::optional<PublishedMap> newest;
    if (content(recording).empty()) return newest;
    recording::RecordingReader reader(recording);
    while (auto message = reader.next())
      if (auto* map = std::get_if<PublishedMap>(&message->message)) newest = std::move(*map);
    return newest;
  }
  static bool tells_of_the_end(const PublishedMap& map) {
    return map.map.stamp_ns > 0 && map.state == MapState::stale;
  }
};

TEST_F(RecordedLoopback, AReplayMakesTheMapsThatTheServicePublished) {
  record({"publish", "--scenario", "split", "--noise", "inhouse", "--duration", "8"}, "live.mcap");
  ASSERT_EQ(run({"replay", "--in", file("live.mcap"), "--verify", "--report", file("live.json")}), 0)
      << output();
  const json live = json::parse(content(file("live.json")));
  EXPECT_GE(live.at("frames"), 77);
  // With another configuration they are others, and that is seen.
  EXPECT_EQ(run({"replay", "--in", file("live.mcap"), "--verify", "--preset", "av2"}), 2) << output();

  // Published again, the same messages make the same maps, in the service and in a replay.
  record({"replay", "--in", file("live.mcap"), "--publish", "--speed-up", "2"}, "again.mcap");
  ASSERT_EQ(run({"replay", "--in", file("again.mcap"), "--verify", "--report", file("again.json")}), 0)
      << output();
  EXPECT_EQ(json::parse(content(file("again.json"))).at("hash"), live.at("hash"));
}

TEST_F(Loopback, AReplayAnnouncesObjectsOnlyWhereThereAreSome) {
  DdsConfig dds;
  dds.domain = own_domain();
  for (const bool with_objects : {false, true}) {
    std::vector<std::string> simulate{"simulate", "--scenario", "straight",         "--duration",
                                      "1",        "--frames",   file("drive.jsonl")};
    if (with_objects) simulate.insert(simulate.end(), {"--traffic", "usual"});
    ASSERT_EQ(run(simulate), 0) << output();
    const dds::Discovery discovery(dds, "test");
    const auto is_written = [&](const char* topic) {
      return std::ranges::any_of(discovery.endpoints(), [&](const dds::Endpoint& endpoint) {
        return endpoint.is_writer && endpoint.topic == topic;
      });
    };
    const support::ChildProcess replay(command({LANELOOM_COMMAND, "replay", "--in", file("drive.jsonl"),
                                                "--publish", "--wait-for-readers", "1"}),
                                       file("replay.log"));
    // Writers are announced in the order in which they are made, and that of poses is the last.
    ASSERT_TRUE(eventually([&] { return is_written(dds::kVehiclePoseTopic); }))
        << content(file("replay.log"));
    EXPECT_EQ(is_written(dds::kObjectsTopic), with_objects);
  }
}

TEST_F(Loopback, ThePlannerOutlivesTheService) {
  support::ChildProcess publisher(command({LANELOOM_COMMAND, "publish", "--scenario", "straight", "--loop"}),
                                  file("publish.log"));
  support::ChildProcess planner(command({LANELOOM_COMMAND, "pnc", "--json"}), file("pnc.log"));
  auto service = std::make_unique<support::ChildProcess>(command({LANELOOM_SERVICE}), file("service.log"));
  ASSERT_TRUE(wait_for("pnc.log", kOk, 1));
  service.reset();  // kill -9
  ASSERT_TRUE(wait_for("pnc.log", "liveliness_lost", 1));
  const int before = seen("pnc.log", kOk);
  service = std::make_unique<support::ChildProcess>(command({LANELOOM_SERVICE}), file("service.log"));
  EXPECT_TRUE(wait_for("pnc.log", kOk, before + 1));
  planner.signal(SIGTERM);
  EXPECT_EQ(planner.wait(), 0) << content(file("pnc.log")).substr(0, 4000);
}

}  // namespace
}  // namespace laneloom
