#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "participants.hpp"
#include "process.hpp"
#include "service.hpp"

// Real processes over real DDS: laneloomd is started as anyone would start it.
namespace laneloom {
namespace {

TEST(Laneloomd, DetectionsBecomeLanesAtThePlanner) {
  const auto config = private_config();
  const Process service(command(config));
  Listener<PublishedMap> maps(config);
  Listener<RoadMarkings> markings(config);
  ASSERT_TRUE(maps.wait_for([](const PublishedMap&) { return true; })) << service.errors();
  const StraightRoad road(config);
  ASSERT_TRUE(maps.wait_for(is_good)) << service.errors();
  ASSERT_TRUE(markings.wait_for([](const RoadMarkings& m) { return m.markings.size() == 2; }));

  const auto samples = maps.samples();
  const auto good = *std::find_if(samples.begin(), samples.end(), is_good);
  EXPECT_EQ(good.frame_id, "map");
  EXPECT_GE(good.age_s, 0.0);
  ASSERT_EQ(good.map.lanes.size(), 1U);
  EXPECT_NEAR(good.map.lanes[0].width_m, 3.5, 0.3);
  EXPECT_GT(good.map.T_map_body.translation().x(), 1.0);
  std::set<std::uint64_t> fused;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(samples[i].sequence, samples[0].sequence + i);
    for (const auto& frame : samples[i].fused_frames) {
      EXPECT_TRUE(fused.insert(frame.sequence).second) << frame.sequence << " is named twice";
    }
  }
  EXPECT_GT(fused.size(), 2U);
}

/// Whether each of the newest `count` maps has a frame that came less than 40 ms before.
bool follow_their_frames(const std::vector<PublishedMap>& maps, std::ptrdiff_t count) {
  return std::ssize(maps) >= count &&
         std::all_of(maps.end() - count, maps.end(),
                     [](const PublishedMap& map) { return !map.fused_frames.empty() && map.age_s < 0.04; });
}

TEST(Laneloomd, MapsFollowFramesOfAnotherPeriod) {
  const auto config = private_config();
  const Process service(command(config));
  Listener<PublishedMap> maps(config);
  const StraightRoad road(config,
                          110);  // ticks that did not follow them would meet each phase within 11 frames
  EXPECT_TRUE(maps.wait_for([&, seen = std::vector<PublishedMap>()](const PublishedMap& map) mutable {
    seen.push_back(map);
    return follow_their_frames(seen, 25);
  })) << service.errors();
}

TEST(Laneloomd, PublishesAlsoWhenNothingComes) {
  const auto config = private_config();
  const Process service(command(config));
  Listener<PublishedMap> maps(config);
  Listener<ServiceStatus> status(config);
  ASSERT_TRUE(maps.wait_for([](const PublishedMap& map) { return map.sequence >= 5; })) << service.errors();
  const auto map = maps.samples().back();
  EXPECT_EQ(map.state, MapState::stale);
  EXPECT_EQ(map.age_s, -1.0);
  ASSERT_TRUE(status.wait_for([](const ServiceStatus& s) { return s.sequence >= 1; }));
  EXPECT_EQ(status.samples().back().version, LANELOOM_TEST_VERSION);
}

TEST(Laneloomd, TheMapTurnsStaleWhenDetectionsStopAndSaysWhy) {
  const auto config = private_config();
  const Process service(command(config));
  Listener<PublishedMap> maps(config);
  StraightRoad road(config);
  ASSERT_TRUE(maps.wait_for(is_good)) << service.errors();
  road.stop();
  const auto stale = [](const PublishedMap& map) {
    return map.state == MapState::stale && has_lanes(map) && map.age_s > 0.4 &&
           map.reasons == std::vector{StateReason::no_detections, StateReason::no_poses};
  };
  EXPECT_TRUE(maps.wait_for(stale));
}

TEST(Laneloomd, ALateJoinerGetsTheNewestMapAtOnce) {
  // At so few maps a second, the first that a joiner gets is often one that another has had for long, if any
  // is kept for it.
  const TemporaryFile file("slow.yaml", "service:\n  tick_rate_hz: 8\n");
  const auto config = private_config();
  const Process service(command(config, {"--config", file.path}));
  Listener<PublishedMap> first(config);
  ASSERT_TRUE(first.wait_for([](const PublishedMap&) { return true; })) << service.errors();
  bool got_kept = false;
  for (int attempt = 0; attempt < 20 && !got_kept; ++attempt) {
    const auto before = first.samples().back().sequence;
    auto newest = before, long_newest = before;
    Listener<PublishedMap> late(config);
    for (int i = 0; i < 600 && late.samples().empty(); ++i) {
      long_newest = std::exchange(newest, first.samples().back().sequence);
      usleep(50'000);
    }
    ASSERT_FALSE(late.samples().empty()) << service.errors();
    EXPECT_GE(late.samples().front().sequence, before) << "not the newest";
    got_kept = late.samples().front().sequence <= long_newest;
  }
  EXPECT_TRUE(got_kept);
}

TEST(Laneloomd, SigtermEndsItCleanly) {
  const auto config = private_config();
  Process service(command(config));
  Listener<PublishedMap> maps(config);
  const StraightRoad road(config);
  ASSERT_TRUE(maps.wait_for(has_lanes)) << service.errors();
  service.signal(SIGTERM);
  EXPECT_EQ(service.wait(), 0) << service.errors();
}

TEST(Laneloomd, AfterKillAndRestartTheOthersGoOn) {
  const auto config = private_config();
  Listener<PublishedMap> maps(config);
  const StraightRoad road(config);
  std::uint64_t first_session = 0;
  {
    Process service(command(config));
    ASSERT_TRUE(maps.wait_for(is_good)) << service.errors();
    first_session = maps.samples().back().session_id;
    service.signal(SIGKILL);
    EXPECT_EQ(service.wait(), -SIGKILL);
  }
  EXPECT_TRUE(maps.wait_for_alive(0));
  maps.forget();
  const Process service(command(config));
  ASSERT_TRUE(maps.wait_for(is_good)) << service.errors();
  EXPECT_NE(maps.samples().back().session_id, first_session);
}

TEST(Laneloomd, ReopensItsEndpointsAndKeepsTheMap) {
  const auto config = private_config();
  const Process service(command(config));
  Listener<PublishedMap> maps(config);
  const StraightRoad road(config);
  ASSERT_TRUE(maps.wait_for(is_good)) << service.errors();
  const auto before = maps.samples().back();
  service.signal(SIGHUP);
  ASSERT_TRUE(maps.wait_for_alive(0));
  maps.forget();
  ASSERT_TRUE(maps.wait_for(is_good)) << service.errors();
  const auto after = maps.samples();
  EXPECT_TRUE(has_lanes(after.front())) << "the map was forgotten";
  EXPECT_EQ(after.front().session_id, before.session_id);
  EXPECT_GT(after.front().sequence, before.sequence);
  EXPECT_EQ(after.back().map.lanes[0].id, before.map.lanes[0].id);
}

TEST(Laneloomd, DamagedFramesAreRefusedAndCountedWhileGoodOnesGoOn) {
  const auto config = private_config();
  const Process service(command(config));
  Listener<PublishedMap> maps(config);
  Listener<ServiceStatus> status(config);
  StraightRoad road(config);
  road.send_frames([](DetectionFrame frame) {
    auto& point = frame.detections[0].points[0];
    if (frame.sequence % 4 == 1) point.x() = std::numeric_limits<double>::quiet_NaN();
    if (frame.sequence % 4 == 3) frame.detections[0].confidence = 7.0;
    return std::vector{frame};
  });
  ASSERT_TRUE(maps.wait_for(is_good)) << service.errors();
  road.stop();
  status.forget();

  // Frames written before the service's reader knew their writer never arrived: it reads best effort.
  std::map<std::string, std::uint64_t> counters;
  const auto settled = [&](const ServiceStatus& s) {
    counters = {s.counters.begin(), s.counters.end()};
    return s.detections_age_s > 0.5 && s.pending_frames == 0;
  };
  ASSERT_TRUE(status.wait_for(settled));
  std::uint64_t accounted = counters["frames_fused"] + counters["frames_dropped_queue_full"];
  for (const auto& [name, count] : counters) {
    if (name.starts_with("detections_refused_")) accounted += count;
  }
  EXPECT_EQ(counters["detections_received"], accounted);
  EXPECT_LE(counters["detections_received"], road.frames_written());
  EXPECT_GT(counters["frames_fused"], 2U);
  EXPECT_GE(counters["detections_refused_not_finite"], 1U);
  EXPECT_GE(counters["detections_refused_confidence"], 1U);
  for (const auto& map : maps.samples()) {
    for (const auto& frame : map.fused_frames)
      EXPECT_EQ(frame.sequence % 2, 0U) << "a damaged frame was fused";
  }
}

TEST(Laneloomd, VehiclesDoNotMix) {
  const auto ours = private_config("ours");
  const auto theirs = private_config("theirs");
  const Process our_service(command(ours)), their_service(command(theirs));
  Listener<PublishedMap> our_maps(ours), their_maps(theirs);
  ASSERT_TRUE(their_maps.wait_for([](const PublishedMap&) { return true; })) << their_service.errors();
  const StraightRoad road(ours);
  ASSERT_TRUE(our_maps.wait_for(is_good)) << our_service.errors();
  const auto newest = their_maps.samples().back().sequence;
  ASSERT_TRUE(their_maps.wait_for([&](const PublishedMap& map) { return map.sequence > newest + 3; }));

  std::set<std::uint64_t> our_sessions, their_sessions;
  for (const auto& map : our_maps.samples()) our_sessions.insert(map.session_id);
  for (const auto& map : their_maps.samples()) {
    their_sessions.insert(map.session_id);
    EXPECT_EQ(map.map.stamp_ns, 0);
  }
  EXPECT_EQ(our_sessions.size(), 1U);
  EXPECT_EQ(their_sessions.size(), 1U);
  EXPECT_NE(our_sessions, their_sessions);
}

// Both would write their maps to one topic of ROS 2.
TEST(Laneloomd, VehiclesInOneNamespaceOfRosSaySo) {
  const TemporaryFile file("ros.yaml", "ros2:\n  enabled: true\n");
  const auto ours = private_config("ours");
  const auto theirs = private_config("theirs");
  const Process our_service(command(ours, {"--config", file.path}));
  Process their_service(command(theirs, {"--config", file.path}));
  Listener<PublishedMap> our_maps(ours), their_maps(theirs);
  const auto warns = [](const PublishedMap& map) {
    return std::ranges::count(map.reasons, StateReason::another_service) > 0;
  };
  EXPECT_TRUE(our_maps.wait_for(warns)) << our_service.errors();
  EXPECT_TRUE(their_maps.wait_for(warns)) << their_service.errors();
  their_service.signal(SIGTERM);
  EXPECT_EQ(their_service.wait(), 0);
  our_maps.forget();
  EXPECT_TRUE(our_maps.wait_for([&](const PublishedMap& map) { return !warns(map); }));
}

TEST(Laneloomd, ABadConfigurationStopsTheStart) {
  const TemporaryFile file("bad.yaml", "sync:\n  max_wait_s: 0.5\n  max_wiat_s: 0.5\n");
  for (const auto& more : {std::vector<std::string>{}, std::vector<std::string>{"--check-config"}}) {
    auto words = command(private_config(), {"--config", file.path});
    words.insert(words.end(), more.begin(), more.end());
    Process service(words);
    EXPECT_EQ(service.wait(), 78);
    EXPECT_NE(service.errors().find(file.path + ":3: sync.max_wiat_s: is not a known key"), std::string::npos)
        << service.errors();
  }
  Process bad_domain({LANELOOMD, "--domain", "233"});
  EXPECT_EQ(bad_domain.wait(), 78);
  Process bad_preset({LANELOOMD, "--preset", "mine"});
  EXPECT_EQ(bad_preset.wait(), 78);
  Process unknown_option({LANELOOMD, "--nonsense"});
  EXPECT_EQ(unknown_option.wait(), 78);
}

TEST(Laneloomd, AFileThatTheConfigurationNamesAndThatIsMissingStopsTheStart) {
  for (const std::string section :
       {"dds:\n  profile_file: /nonexistent\n  profile_name: mine\n",
        "dds:\n  security_directory: /nonexistent\n", "sd_map:\n  file: /nonexistent\n"}) {
    const TemporaryFile file("missing.yaml", section);
    for (const auto& more : {std::vector<std::string>{}, std::vector<std::string>{"--check-config"}}) {
      auto words = command(private_config(), {"--config", file.path});
      words.insert(words.end(), more.begin(), more.end());
      Process service(words);
      EXPECT_EQ(service.wait(), 78) << section;
      EXPECT_NE(service.errors().find("/nonexistent"), std::string::npos) << service.errors();
    }
  }
}

TEST(Laneloomd, ChecksAConfigurationAndSaysItsVersion) {
  Process check(command(private_config(), {"--check-config", "--preset", "av2"}));
  EXPECT_EQ(check.wait(), 0);
  Process version({LANELOOMD, "--version"});
  EXPECT_EQ(version.wait(), 0);
  Process help({LANELOOMD, "--help"});
  EXPECT_EQ(help.wait(), 0);
  for (const std::string option : {"--check-config", "--dump-config"}) {
    Process unprinted({"/bin/sh", "-c", "exec " LANELOOMD " " + option + " > /dev/full"});
    EXPECT_EQ(unprinted.wait(), EXIT_FAILURE) << option;
  }
}

}  // namespace
}  // namespace laneloom
