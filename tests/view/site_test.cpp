#include "view/site.hpp"

#include <gmock/gmock.h>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace laneloom::view {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(Site, HasThePageAndNothingElse) {
  const FrameStore frames;
  const BlackBox box({}, {});
  const Site site({.title = "a vehicle", .black_box = &box}, frames);
  EXPECT_THAT(site.answer("/").body, HasSubstr("<title>laneloom</title>"));
  EXPECT_EQ(site.answer("/").body, site.answer("/index.html").body);
  EXPECT_EQ(site.answer("/main.js").type, "text/javascript; charset=utf-8");
  EXPECT_EQ(json::parse(site.answer("/info").body),
            json::parse(R"({"title": "a vehicle", "live": true, "names": [], "max_file_bytes": 0})"));
  EXPECT_TRUE(json::parse(site.answer("/palette").body).contains("styles"));
  for (const char* none :
       {"", "/nothing", "/../main.js", "//main.js", "/main.js/", "/recording?from=x", "/frame?number=0"})
    EXPECT_EQ(site.answer(none).status, 404U) << none;
}

TEST(Site, GivesTheFramesOfARecordingWhileItIsRead) {
  FrameStore store;
  const Site site({.title = "drive.mcap", .names = {"A.yaml", "B.yaml"}}, store);
  EXPECT_EQ(json::parse(site.answer("/info").body)["names"], json::parse(R"(["A.yaml", "B.yaml"])"));
  EXPECT_EQ(json::parse(site.answer("/recording?from=0").body)["complete"], false);
  const std::string frame(100'000, 'x');
  store.add(0, R"({"number":0})", frame);
  store.add(0, R"({"number":1})", "second");
  EXPECT_EQ(site.answer("/frame?number=0").body, frame);
  EXPECT_EQ(site.answer("/frame?number=1").body, "second");
  for (const char* none : {"2", "-1", "", "1x", "18446744073709551616", "0x1"})
    EXPECT_EQ(site.answer(std::string("/frame?number=") + none).status, 404U) << none;
  store.finish("the file is cut off");
  const json rest = json::parse(site.answer("/recording?from=1").body);
  EXPECT_EQ(rest,
            json::parse(R"({"complete": true, "error": "the file is cut off", "frames": [{"number": 1}]})"));
  EXPECT_EQ(json::parse(site.answer("/recording?from=99").body)["frames"], json::array());
  EXPECT_EQ(site.answer("/metrics").status, 404U);
  EXPECT_EQ(site.answer("/save").status, 404U);
}

TEST(FrameStore, WhatWasWrongMayNameWhatIsNoText) {
  FrameStore store;
  store.finish("unknown compression \"\xff\"");
  EXPECT_EQ(json::parse(store.summaries(0))["error"], "unknown compression \"\ufffd\"");
}

TEST(FrameStore, KeepsWhatItsLimitsAllow) {
  FrameStore store({.span_s = 10.0});
  for (int i = 0; i < 300; ++i)
    store.add(i * 100'000'000LL, fmt::format(R"({{"number":{}}})", i), fmt::format("frame {}", i));
  EXPECT_EQ(store.size(), 300U);
  EXPECT_FALSE(store.frame(100));
  EXPECT_EQ(store.frame(250), "frame 250");
  EXPECT_EQ(store.frame(299), "frame 299");
  const json kept = json::parse(store.summaries(0))["frames"];
  const std::size_t first = kept.front()["number"];
  EXPECT_GE(first, 190U);
  EXPECT_LE(first, 200U);
  EXPECT_EQ(kept.size(), 300 - first);
  EXPECT_EQ(store.frame(first), fmt::format("frame {}", first));
  EXPECT_FALSE(store.frame(first - 1));
  EXPECT_EQ(json::parse(store.summaries(298))["frames"].size(), 2U);
}

TEST(FrameStore, BytesAreLimited) {
  FrameStore store({.bytes = 100'000});
  std::string frame(50'000, '\0');
  std::uint32_t noise = 1;
  for (int i = 0; i < 100; ++i) {
    for (char& byte : frame) byte = static_cast<char>((noise = noise * 1664525U + 1013904223U) >> 24U);
    store.add(i, "{}", frame);
  }
  EXPECT_LT(json::parse(store.summaries(0))["frames"].size(), 10U);
}

TEST(Site, HasTheServicesFiguresForPrometheus) {
  const FrameStore frames;
  const BlackBox box({}, {});
  Site site({.title = "a vehicle", .black_box = &box}, frames);
  EXPECT_EQ(site.answer("/metrics").status, 503U);
  ServiceStatus status{.state = MapState::degraded, .reasons = {StateReason::no_poses}};
  status.tick.p99_ms = 2.5;
  status.counters = {{"detections_fused", 7}};
  status.sources = {{.source = "a \"quoted\\ näme\n", .session_id = 3, .frames = 9},
                    {.source = "no \xff text", .session_id = 4, .frames = 8}};
  site.set_status(status);
  const WebAnswer answer = site.answer("/metrics");
  EXPECT_EQ(answer.type, "text/plain; version=0.0.4; charset=utf-8");
  for (const char* line :
       {"# TYPE laneloom_state gauge\n", "laneloom_state{state=\"DEGRADED\"} 1\n",
        "laneloom_state{state=\"OK\"} 0\n", "laneloom_reason{reason=\"no_poses\"} 1\n",
        "laneloom_tick_seconds{statistic=\"p99\"} 0.0025\n",
        "laneloom_events_total{counter=\"detections_fused\"} 7\n", "laneloom_poses_age_seconds -1\n"})
    EXPECT_THAT(answer.body, HasSubstr(line));
  EXPECT_THAT(answer.body,
              HasSubstr(R"(laneloom_source_frames_total{source="a \"quoted\\ näme\n",session="3"} 9)"));
  EXPECT_THAT(answer.body,
              HasSubstr("laneloom_source_frames_total{source=\"no \uFFFD text\",session=\"4\"} 8"));
  // Each line is a comment or a sample, whatever a source calls itself.
  std::istringstream lines(answer.body);
  for (std::string line; std::getline(lines, line);)
    EXPECT_THAT(line, testing::MatchesRegex("# .*|[a-z_]+([{].*[}])? -?[0-9.e+-]+"));
}

}  // namespace
}  // namespace laneloom::view
