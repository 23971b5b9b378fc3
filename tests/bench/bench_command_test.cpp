#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "own_domain.hpp"

namespace laneloom::bench {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class BenchCommand : public Commands {
 protected:
  int run(const std::string& words) const override { return run_lab("bench " + words); }

  /// A program that reports this, wherever it is asked to.
  void make_peer(const std::string& report) {
    std::ofstream(file("peer")) << "#!/bin/sh\nwhile [ \"$1\" != --report ]; do shift; done\necho '" << report
                                << "' > \"$2\"\n";
    std::filesystem::permissions(file("peer"), std::filesystem::perms::owner_all);
  }

  const std::string short_drive_ = "--scenario straight --duration 1 --json";
};

void expect_times(const json& ms, const std::string& what) {
  for (const char* key : {"mean", "p50", "p99", "max"}) EXPECT_GE(ms.at(key), 0.0) << what;
  EXPECT_LE(ms.at("p50"), ms.at("p99")) << what;
  EXPECT_LE(ms.at("p99"), ms.at("max")) << what;
}

TEST_F(BenchCommand, TimesStagesAndCountsMemory) {
  ASSERT_TRUE(done(short_drive_));
  const json result = json::parse(output());
  EXPECT_EQ(result.at("frames"), 10);
  for (const char* stage : {"preprocess", "association", "polylines", "lanes", "total"})
    expect_times(result.at("ms").at(stage), stage);
  EXPECT_GT(result.at("ms").at("total").at("mean"), result.at("ms").at("association").at("mean"));
  EXPECT_GT(result.at("allocations_per_frame"), 10.0);
  EXPECT_GT(result.at("peak_heap_mb"), result.at("heap_mb"));
  EXPECT_GT(result.at("peak_rss_mb"), 1.0);
  EXPECT_TRUE(result.at("peer").is_null());
}

TEST_F(BenchCommand, HoldsThePeersOwnTimesAgainstOurs) {
  make_peer(
      R"({"frames": 10, "peak_rss_mb": 12.5, "ms": {"fuse": {"mean": 3, "p50": 3, "p99": 3, "max": 3},
          "total": {"mean": 40, "p50": 39, "p99": 90, "max": 95}}})");
  ASSERT_TRUE(done(short_drive_ + " --peer ./peer"));
  const json result = json::parse(output()), &peer = result.at("peer"), &ours = result.at("ms").at("total");
  EXPECT_EQ(peer.at("peak_rss_mb"), 12.5);
  EXPECT_EQ(peer.at("ms").at("fuse").at("p99"), 3.0);
  EXPECT_DOUBLE_EQ(peer.at("ratio").at("mean"), 40.0 / ours.at("mean").get<double>());
  EXPECT_DOUBLE_EQ(peer.at("ratio").at("p99"), 90.0 / ours.at("p99").get<double>());
}

TEST_F(BenchCommand, APeerWithoutAWholeReportIsNamed) {
  for (const char* report : {"no json", R"({"frames": 10, "peak_rss_mb": 1, "ms": {}})",
                             R"({"frames": 9, "peak_rss_mb": 1, "ms": {}})"}) {
    make_peer(report);
    EXPECT_EQ(run(short_drive_ + " --peer ./peer"), 1) << report;
    EXPECT_THAT(output(), HasSubstr("./peer"));
  }
}

TEST_F(BenchCommand, ScalesByDetectionsRangeTimeAndVehicles) {
  ASSERT_TRUE(done("scale " + short_drive_ + " --minutes 3"));
  const json result = json::parse(output());
  EXPECT_EQ(result.at("detections").size(), 5U);
  EXPECT_EQ(result.at("detections").back().at("factor"), 16);
  EXPECT_GT(result.at("detections").back().at("markings"), result.at("detections").front().at("markings"));
  EXPECT_EQ(result.at("range").back().at("factor"), 8);
  for (const char* kind : {"driving", "standing"}) {
    ASSERT_EQ(result.at(kind).size(), 3U);
    EXPECT_EQ(result.at(kind).back().at("minute"), 3);
    EXPECT_GT(result.at(kind).back().at("rss_mb"), 1.0);
  }
  EXPECT_EQ(result.at("vehicles").back().at("vehicles"), 16);
  for (const auto& [kind, rows] : result.items())
    for (const json& row : rows) expect_times(row.at("ms"), kind);
}

TEST_F(BenchCommand, TimesTheMapsOfARealService) {
  const std::string domain = std::to_string(own_domain());
  for (const char* transport : {"udp", "udp+shm"}) {
    ASSERT_TRUE(done("latency --scenario straight --duration 3 --domain " + domain + " --transport " +
                     transport + " --load --viewers 2 --json"));
    const json result = json::parse(output());
    EXPECT_EQ(result.at("transport"), transport);
    EXPECT_GE(result.at("busy_threads"), 1);
    EXPECT_GE(result.at("ticks"), 1);
    EXPECT_GE(result.at("frames"), 1);
    EXPECT_TRUE(result.at("missed_deadlines").is_number_unsigned());
    EXPECT_TRUE(result.at("maps_lost").is_number_unsigned());
    for (const char* span :
         {"tick_delay", "tick_to_callback", "publication_to_callback", "detections_to_callback"})
      expect_times(result.at("ms").at(span), span);
    EXPECT_GT(result.at("service").at("cpu_percent"), 0.0);
    EXPECT_GT(result.at("service").at("peak_rss_mb"), 1.0);
    EXPECT_GT(result.at("viewer").at("cpu_percent"), 0.0);
    EXPECT_GT(result.at("viewer").at("peak_rss_mb"), 1.0);
    EXPECT_GT(result.at("viewer").at("frames_per_s"), 0.0);
  }
}

TEST_F(BenchCommand, PrintsTables) {
  ASSERT_TRUE(done("--scenario straight --duration 1"));
  EXPECT_THAT(output(), HasSubstr("association"));
  EXPECT_THAT(output(), HasSubstr("allocations per frame"));
}

TEST_F(BenchCommand, WrongInputIsNamed) {
  EXPECT_NE(run("--scenario nowhere"), 0);
  EXPECT_NE(run("--duration 0"), 0);
  EXPECT_NE(run("--peer /nowhere/peer"), 0);
  EXPECT_NE(run("latency --transport pigeon"), 0);
  EXPECT_NE(run("scale --minutes 0"), 0);
}

TEST_F(BenchCommand, OptionsBeforeASubcommandAreRefused) {
  for (const std::string what : {"latency", "scale"}) {
    for (const std::string option : {"--json", "--seed 3", "--duration 1"}) {
      EXPECT_GT(run(option + " " + what + " --scenario straight --duration 0.1"), 1) << what << option;
      EXPECT_THAT(output(), HasSubstr(option.substr(0, option.find(' '))));
    }
  }
}

TEST_F(BenchCommand, MicroBenchmarksHaveEveryStage) {
  ASSERT_EQ(shell("'" LANELOOM_MICROBENCH "' --benchmark_list_tests"), 0);
  for (const char* one : {"lines/association", "lines/linkages", "voxels/clustering", "map_to_cdr"})
    EXPECT_THAT(output(), HasSubstr(one));
}

}  // namespace
}  // namespace laneloom::bench
