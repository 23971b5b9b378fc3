#include <gtest/gtest.h>

#include <csignal>
#include <memory>

#include "faults.hpp"

// A service that was killed goes on with its snapshot; deploy/README.md, "After a crash".
namespace laneloom {
namespace {

class WarmRestart : public Faults {
 protected:
  WarmRestart()
      : snapshot_("snapshot", ""),
        file_("warm.yaml", "service:\n  snapshot_file: " + snapshot_.path + "\n  snapshot_period_s: 0.1\n") {
    unlink(snapshot_.path.c_str());
  }
  /// Kills the service, which had lanes, and starts it again.
  void restart(const std::vector<std::string>& more) {
    ASSERT_TRUE(rises("snapshots_written", counters())) << service_->errors();
    service_->signal(SIGKILL);
    ASSERT_EQ(service_->wait(), -SIGKILL);
    ASSERT_TRUE(maps_.wait_for_alive(0));
    before_ = maps_.samples().back();
    maps_.forget();
    status_.forget();
    road_->send_frames(lose<DetectionFrame>);  // on a busy host the first map that is seen may be a later one
    service_ = std::make_unique<Process>(command(config_, more));
    ASSERT_TRUE(maps_.wait_for([](const PublishedMap&) { return true; })) << service_->errors();
    first_ = maps_.samples().front();
    road_->send_frames({});
  }

  const TemporaryFile snapshot_, file_;
  PublishedMap before_, first_;  ///< the last map before the restart, the first one after it
};

TEST_F(WarmRestart, GoesOnWithTheMapThatItHad) {
  start(100, {"--config", file_.path});
  ASSERT_TRUE(stays_good(10));  // a snapshot at each
  file_.write("service:\n  snapshot_file: " + snapshot_.path +
              "\n  stale_after_s: 30\n  degraded_after_s: 20\n");
  restart({"--config", file_.path});
  ASSERT_EQ(first_.map.lanes.size(), 1U) << service_->errors();
  EXPECT_EQ(first_.state, MapState::stale) << "no frame has confirmed it";
  EXPECT_NE(first_.session_id, before_.session_id);
  EXPECT_EQ(first_.map.lanes[0].id, before_.map.lanes[0].id);
  EXPECT_GT(first_.age_s, 0.0);
  ASSERT_TRUE(maps_.wait_for(is_good)) << service_->errors();
  EXPECT_EQ(maps_.samples().back().map.lanes[0].id, before_.map.lanes[0].id);
  auto since_restart = counters();
  EXPECT_EQ(since_restart["snapshots_resumed"], 1U);
  EXPECT_EQ(since_restart["map_resets"], 0U);
}

TEST_F(WarmRestart, GoesOnAfterThreeEndsInARowAndThenBeginsAnew) {
  start(100, {"--config", file_.path});
  ASSERT_TRUE(stays_good(10));               // a snapshot at each
  road_->send_frames(lose<DetectionFrame>);  // so that no service in between makes a snapshot of its own
  for (const std::size_t lanes : {1U, 1U, 1U, 0U}) {
    const auto session = maps_.samples().back().session_id;
    service_->signal(SIGKILL);
    ASSERT_EQ(service_->wait(), -SIGKILL);
    service_ = std::make_unique<Process>(command(config_, {"--config", file_.path}));
    std::size_t found = 0;
    ASSERT_TRUE(maps_.wait_for([&](const PublishedMap& map) {
      found = map.map.lanes.size();
      return map.session_id != session;
    })) << service_->errors();
    EXPECT_EQ(found, lanes) << service_->errors();
    maps_.forget();
    ASSERT_TRUE(maps_.wait_for([](const PublishedMap&) { return true; }));
  }
}

TEST_F(WarmRestart, RefusesWhatAnotherConfigurationMade) {
  start(100, {"--config", file_.path});
  ASSERT_TRUE(stays_good(10));  // a snapshot at each
  restart({"--config", file_.path, "--preset", "av2"});
  EXPECT_TRUE(first_.map.lanes.empty());
  EXPECT_NE(service_->errors().find("snapshot_refused"), std::string::npos) << service_->errors();
  EXPECT_EQ(counters()["snapshots_refused"], 1U);
  EXPECT_TRUE(maps_.wait_for(is_good));
}

TEST_F(WarmRestart, AServiceThatCannotStartLeavesTheSnapshotToTheNext) {
  start(100, {"--config", file_.path});
  ASSERT_TRUE(rises("snapshots_written", counters())) << service_->errors();
  service_->signal(SIGKILL);
  ASSERT_EQ(service_->wait(), -SIGKILL);
  file_.write("service:\n  snapshot_file: " + snapshot_.path +
              "\ndds:\n  profile_file: /nonexistent\n  profile_name: mine\n");
  Process refused(command(config_, {"--config", file_.path}));
  EXPECT_EQ(refused.wait(), 78) << refused.errors();
  EXPECT_EQ(access(snapshot_.path.c_str(), F_OK), 0) << refused.errors();
}

}  // namespace
}  // namespace laneloom
