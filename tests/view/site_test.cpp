#include "view/site.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace laneloom::view {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(Site, HasThePageAndNothingElse) {
  const Site site("a vehicle", "[]", nullptr);
  EXPECT_THAT(site.answer("/").body, HasSubstr("<title>laneloom</title>"));
  EXPECT_EQ(site.answer("/").body, site.answer("/index.html").body);
  EXPECT_EQ(site.answer("/main.js").type, "text/javascript; charset=utf-8");
  EXPECT_EQ(json::parse(site.answer("/info").body),
            json::parse(R"({"title": "a vehicle", "live": true, "names": []})"));
  EXPECT_TRUE(json::parse(site.answer("/palette").body).contains("styles"));
  for (const char* none :
       {"", "/nothing", "/../main.js", "//main.js", "/main.js/", "/recording?from=0", "/frame?number=0"})
    EXPECT_EQ(site.answer(none).status, 404U) << none;
}

TEST(Site, GivesTheFramesOfARecordingWhileItIsRead) {
  FrameStore store;
  const Site site("drive.mcap", "[]", &store, {"A.yaml", "B.yaml"});
  EXPECT_EQ(json::parse(site.answer("/info").body)["names"], json::parse(R"(["A.yaml", "B.yaml"])"));
  EXPECT_EQ(json::parse(site.answer("/recording?from=0").body)["complete"], false);
  const std::string frame(100'000, 'x');
  store.add(R"({"number":0})", frame);
  store.add(R"({"number":1})", "second");
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
}

TEST(Site, HasTheServicesFiguresForPrometheus) {
  Site site("a vehicle", "[]", nullptr);
  EXPECT_EQ(site.answer("/metrics").status, 503U);
  ServiceStatus status{.state = MapState::degraded, .reasons = {StateReason::no_poses}};
  status.tick.p99_ms = 2.5;
  status.counters = {{"detections_fused", 7}};
  status.sources = {{.source = "a \"quoted\\ name\n", .session_id = 3, .frames = 9}};
  site.set_status(status);
  const WebAnswer answer = site.answer("/metrics");
  EXPECT_EQ(answer.type, "text/plain; version=0.0.4");
  for (const char* line :
       {"# TYPE laneloom_state gauge\n", "laneloom_state{state=\"DEGRADED\"} 1\n",
        "laneloom_state{state=\"OK\"} 0\n", "laneloom_reason{reason=\"no_poses\"} 1\n",
        "laneloom_tick_seconds{statistic=\"p99\"} 0.0025\n",
        "laneloom_events_total{counter=\"detections_fused\"} 7\n", "laneloom_poses_age_seconds -1\n"})
    EXPECT_THAT(answer.body, HasSubstr(line));
  EXPECT_THAT(answer.body, HasSubstr("laneloom_source_frames_total{source=\"a \\\"quoted"));
  // Each line is a comment or a sample, whatever a source calls itself.
  std::istringstream lines(answer.body);
  for (std::string line; std::getline(lines, line);)
    EXPECT_THAT(line, testing::MatchesRegex("# .*|[a-z_]+([{].*[}])? -?[0-9.e+-]+"));
}

}  // namespace
}  // namespace laneloom::view
