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

#include "commands.hpp"
#include "io/json_lines.hpp"
#include "laneloom/dds/discovery.hpp"
#include "laneloom/dds/topics.hpp"
#include "own_domain.hpp"
#include "recording/recording.hpp"

// The commands and the service, as processes that meet over DDS.
namespace laneloom {
namespace {

using nlohmann::json;

/// Real processes over real DDS, in a domain of the test's own.
class Loopback : public Commands {
 protected:
  /// How often a process wrote this so far.
  int seen(const std::string& log, const std::string& event) const {
    const std::string all = text(log);
    int count = 0;
    for (auto at = all.find(event); at != std::string::npos; at = all.find(event, at + 1)) ++count;
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

  /// Adds a turn to each frame of a file.
  void tell_turns(const std::string& frames) const {
    std::vector<io::FrameRecord> records;
    io::JsonLinesReader reader(file(frames));
    while (auto record = reader.next_frame()) records.push_back(*std::move(record));
    io::JsonLinesWriter out(file(frames));
    for (io::FrameRecord& record : records) {
      record.next_turn = NextTurn{.turn = Linkage::Turn::left, .distance_m = 80.0};
      out.write(record);
    }
    out.close();
  }

  static constexpr const char* kOk = "\"state\":\"OK\"";
  const std::string dds_ = " --domain " + std::to_string(own_domain()) + " --vehicle-id test";
};

TEST_F(Loopback, PncWithoutServiceSaysSo) { EXPECT_EQ(run("pnc --duration 0.5" + dds_), 3); }

TEST_F(Loopback, ADriveBeginsWhereItIsTold) {
  ASSERT_TRUE(done("publish --scenario straight --duration 0.3 --frames whole" + dds_));
  ASSERT_TRUE(done("publish --scenario straight --from 5 --duration 0.3 --frames later" + dds_));
  io::JsonLinesReader whole(file("whole")), later(file("later"));
  const auto first = whole.next_frame(), moved = later.next_frame();
  ASSERT_TRUE(first && moved);
  EXPECT_NEAR((moved->pose.position - first->pose.position).norm(), 5.0 * 10.0, 0.1);
  EXPECT_EQ(run("publish --scenario straight --loop --from 1000" + dds_), 1);
  EXPECT_THAT(output(), testing::HasSubstr("begin earlier"));
}

TEST_F(Loopback, LanesReachThePlanner) {
  support::ChildProcess service = start("laneloomd" + dds_, "service.log");
  support::ChildProcess publisher = start(
      "laneloom publish --scenario straight --loop --wait-for-readers 1 --frames frames.jsonl --truth "
      "truth.json" +
          dds_,
      "publish.log");
  support::ChildProcess planner =
      start("laneloom pnc --json --require-lanes --record map.jsonl" + dds_, "pnc.log");
  ASSERT_TRUE(wait_for("pnc.log", kOk, 100)) << text("pnc.log");
  planner.signal(SIGTERM);
  EXPECT_EQ(planner.wait(), 0) << text("pnc.log").substr(0, 4000) << text("service.log");
  publisher.signal(SIGTERM);
  EXPECT_EQ(publisher.wait(), 0) << text("publish.log");
  service.signal(SIGTERM);
  EXPECT_EQ(service.wait(), 0) << text("service.log");

  ASSERT_TRUE(done("evaluate --truth truth.json --frames frames.jsonl --map map.jsonl --json score.json"));
  const json fused = json_of("score.json").at("fused");
  EXPECT_GT(fused.at("frames"), 10);
  EXPECT_GT(fused.at("lane").at("precision"), 0.9);
}

/// A drive's recording, made while `driver` publishes it to a service.
class RecordedLoopback : public Loopback {
 protected:
  void record(const std::string& driver, const std::string& name) {
    support::ChildProcess service = start("laneloomd" + dds_, "service.log");
    support::ChildProcess recorder = start("laneloom record --out " + name + dds_, "record.log");
    ASSERT_TRUE(eventually([&] { return newest_map(file(name)).has_value(); }));
    support::ChildProcess publisher =
        start("laneloom " + driver + " --wait-for-readers 2" + dds_, "publish.log");
    ASSERT_EQ(publisher.wait(), 0) << text("publish.log");
    ASSERT_TRUE(eventually([&] { return tells_of_the_end(*newest_map(file(name))); }));
    recorder.signal(SIGTERM);
    ASSERT_EQ(recorder.wait(), 0) << text("record.log");
  }

 private:
  /// The newest map that is written; none: no map came yet. The service publishes maps before it gets any
  /// input.
  static std::optional<PublishedMap> newest_map(const std::string& recording) {
    std::optional<PublishedMap> newest;
    if (content(recording).empty()) return newest;
    recording::RecordingReader reader(recording);
    try {
      while (auto message = reader.next())
        if (auto* map = std::get_if<PublishedMap>(&message->message)) newest = std::move(*map);
    } catch (const std::runtime_error&) {  // its end is not written yet
    }
    return newest;
  }
  static bool tells_of_the_end(const PublishedMap& map) {
    return map.map.stamp_ns > 0 && map.state == MapState::stale;
  }
};

TEST_F(RecordedLoopback, AReplayMakesTheMapsThatTheServicePublished) {
  record("publish --scenario split --noise inhouse --duration 8", "live.mcap");
  ASSERT_TRUE(done("replay live.mcap --verify --report live.json"));
  const json live = json_of("live.json");
  EXPECT_GE(live.at("frames"), 77);
  // With another configuration they are others, and that is seen.
  EXPECT_EQ(run("replay live.mcap --verify --preset av2"), 2) << output();

  // Published again, the same messages make the same maps, in the service and in a replay.
  record("replay live.mcap --publish --speed-up 2", "again.mcap");
  ASSERT_TRUE(done("replay again.mcap --verify --report again.json"));
  EXPECT_EQ(json_of("again.json").at("hash"), live.at("hash"));
}

TEST_F(Loopback, AReplayAnnouncesObjectsAndTurnsOnlyWhereThereAreSome) {
  DdsConfig dds;
  dds.domain = own_domain();
  for (const bool with_objects : {false, true}) {
    const std::string traffic = with_objects ? " --traffic usual" : "";
    ASSERT_TRUE(done("simulate --scenario straight --duration 1 --frames drive.jsonl" + traffic));
    if (with_objects) tell_turns("drive.jsonl");
    const dds::Discovery discovery(dds, "test");
    const auto is_written = [&](const char* topic) {
      return std::ranges::any_of(discovery.endpoints(), [&](const dds::Endpoint& endpoint) {
        return endpoint.is_writer && endpoint.topic == topic;
      });
    };
    const support::ChildProcess replay =
        start("laneloom replay drive.jsonl --publish --wait-for-readers 1" + dds_, "replay.log");
    // Writers are announced in the order in which they are made, and that of poses is the last.
    ASSERT_TRUE(eventually([&] { return is_written(dds::kVehiclePoseTopic); })) << text("replay.log");
    EXPECT_EQ(is_written(dds::kObjectsTopic), with_objects);
    EXPECT_EQ(is_written(dds::kNextTurnTopic), with_objects);
  }
}

TEST_F(RecordedLoopback, TurnsArePublishedAndRecorded) {
  ASSERT_TRUE(done("simulate --scenario straight --duration 4 --frames drive.jsonl"));
  tell_turns("drive.jsonl");
  record("replay drive.jsonl --publish", "live.mcap");
  std::size_t turns = 0;
  std::uint64_t fused = 0;
  recording::RecordingReader reader(file("live.mcap"));
  while (const auto message = reader.next()) {
    if (const auto* turn = std::get_if<NextTurn>(&message->message))
      turns += turn->turn == Linkage::Turn::left && turn->distance_m == 80.0 ? 1U : 0U;
    if (const auto* status = std::get_if<ServiceStatus>(&message->message))
      for (const auto& [name, count] : status->counters)
        if (name == "next_turns_fused") fused = count;
  }
  EXPECT_GT(turns, 30U);
  EXPECT_GT(fused, 0U);
  ASSERT_TRUE(done("replay live.mcap --verify"));
}

TEST_F(Loopback, ThePlannerOutlivesTheService) {
  const auto serve = [&] {
    return std::make_unique<support::ChildProcess>(in_folder("exec laneloomd" + dds_), file("service.log"));
  };
  const support::ChildProcess publisher =
      start("laneloom publish --scenario straight --loop" + dds_, "publish.log");
  support::ChildProcess planner = start("laneloom pnc --json" + dds_, "pnc.log");
  auto service = serve();
  ASSERT_TRUE(wait_for("pnc.log", kOk, 1));
  service.reset();  // kill -9
  ASSERT_TRUE(wait_for("pnc.log", "liveliness_lost", 1));
  const int before = seen("pnc.log", kOk);
  service = serve();
  EXPECT_TRUE(wait_for("pnc.log", kOk, before + 1));
  planner.signal(SIGTERM);
  EXPECT_EQ(planner.wait(), 0) << text("pnc.log").substr(0, 4000);
}

}  // namespace
}  // namespace laneloom
