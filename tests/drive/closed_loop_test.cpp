#include "drive/closed_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "simulation/scenarios.hpp"
#include "thrown_by.hpp"

namespace laneloom::drive {
namespace {

void run(ClosedLoop& loop, double duration_s) {
  while (loop.time_s() < duration_s) loop.step();
}

class BuiltInRoad : public testing::TestWithParam<std::string> {};

TEST_P(BuiltInRoad, WithoutNoiseTheLaneIsNeverLeft) {
  const simulation::Road road = simulation::make_scenario(GetParam());
  LocalMapService service{Config{}};
  ClosedLoop loop(road, {}, service);
  run(loop, 100.0);
  const DriveScore score = loop.score();
  EXPECT_TRUE(score.departures.empty());
  EXPECT_GT(score.driven_m, 600.0);
  EXPECT_LT(score.standing_s, 20.0);
  EXPECT_LT(score.guessed_m(), 0.01 * score.driven_m);
  EXPECT_LT(score.lateral_m.mean(), 0.15);
  EXPECT_LT(score.lateral_mps2.quantile(0.99), 2.75);
  EXPECT_LT(score.lateral_mps2.quantile(1.0), 3.5);
}

std::vector<std::string> all_but_the_town() {
  std::vector<std::string> names = simulation::scenario_names();
  std::erase(names, "town");
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, BuiltInRoad, testing::ValuesIn(all_but_the_town()));

// In the town's wide intersection, the map's path for the turn cuts the corner.
TEST(ClosedLoop, WithoutNoiseTheTownsLanesAreHardlyLeft) {
  const simulation::Road road = simulation::make_scenario("town");
  LocalMapService service{Config{}};
  ClosedLoop loop(road, {}, service);
  run(loop, 300.0);
  const DriveScore score = loop.score();
  EXPECT_GT(score.driven_m, 2000.0);
  EXPECT_LE(score.departures.size(), 2U);
}

/// A service that no turn comes to.
class DeafToTurns : public LocalMapService {
 public:
  using LocalMapService::LocalMapService;
  using LocalMapService::send;
  void send(const NextTurn& /*turn*/) override {}
};

template <class Service>
DriveScore by_published_way(const char* name) {
  const simulation::Road road = simulation::make_scenario(name);
  Service service{Config{}};
  ClosedLoop loop(road, {.by_published_way = true}, service);
  run(loop, 100.0);
  return loop.score();
}

TEST(ClosedLoop, ThePublishedWayMakesTheTurnsThatTheServiceIsTold) {
  for (const char* name : {"t_intersection", "intersection"}) {
    const DriveScore score = by_published_way<LocalMapService>(name);
    EXPECT_GT(score.driven_m, 500.0) << name;
    EXPECT_TRUE(score.departures.empty()) << name;
    EXPECT_EQ(score.missed_turns, 0U) << name;
  }
  EXPECT_GT(by_published_way<DeafToTurns>("intersection").missed_turns, 0U);
}

TEST(ClosedLoop, SaysHowFarItDroveByLanesThatAreInferred) {
  const auto inferred_share = [](const char* name) {
    const simulation::Road road = simulation::make_scenario(name);
    LocalMapService service{Config{}};
    ClosedLoop loop(road, {}, service);
    run(loop, 60.0);
    const DriveScore score = loop.score();
    return score.inferred_m / score.driven_m;
  };
  EXPECT_EQ(inferred_share("straight"), 0.0);
  EXPECT_GT(inferred_share("street"), 0.6);  // of 250 m to drive, 200 have no line
}

TEST(ClosedLoop, TheSameSeedGivesTheSameDrive) {
  const simulation::Road road = simulation::make_scenario("split");
  const auto drive = [&](std::uint64_t seed) {
    LocalMapService service{Config{}};
    ClosedLoop loop(road, {.noise = simulation::noise_profile("inhouse"), .seed = seed, .drift = 0.01},
                    service);
    run(loop, 20.0);
    return std::pair(loop.vehicle().rear_axle, loop.driven_m());
  };
  EXPECT_EQ(drive(1), drive(1));
  EXPECT_NE(drive(1), drive(2));
}

TEST(ClosedLoop, TheMapHearsOfTheTraffic) {
  const simulation::Road road = simulation::make_scenario("street");
  const auto is_told_by_traffic = [](const Lane& lane) {
    return overlap(lane.direction_evidence, Evidence::traffic);
  };
  const auto lanes_told = [&](std::optional<simulation::TrafficProfile> traffic) {
    LocalMapService service{Config{}};
    ClosedLoop loop(road, {.traffic = std::move(traffic)}, service);
    std::ptrdiff_t told = 0;
    for (int second = 1; second <= 20; ++second) {
      run(loop, second);
      told +=
          std::ranges::count_if(service.newest(std::llround(loop.time_s() * 1e9)).lanes, is_told_by_traffic);
    }
    return told;
  };
  EXPECT_EQ(lanes_told(std::nullopt), 0);
  EXPECT_GT(lanes_told(simulation::traffic_profile("exact")), 0);
}

// Else a drive of so many kilometres would never end.
TEST(ClosedLoop, ARoadTooShortToDriveOnIsAnError) {
  simulation::Road road{.name = "stub"};
  road.lanes.push_back({.id = 1,
                        .left = {{0, 2, 0}, {1.2, 2, 0}},
                        .right = {{0, -2, 0}, {1.2, -2, 0}},
                        .centerline = {{0, 0, 0}, {1.2, 0, 0}}});
  road.drive =
      simulation::Drive::recorded({{.stamp_ns = 0}, {.stamp_ns = 1'000'000'000, .position = {1.2, 0, 0}}});
  LocalMapService service{Config{}};
  ClosedLoop loop(road, {.noise = simulation::noise_profile("none")}, service);
  EXPECT_EQ(thrown_by([&] { run(loop, 100.0); }),
            "stub: on this road the vehicle cannot drive a metre from any start")
      << loop.score().road_ends << " ends of the road in " << loop.driven_m() << " m";
}

/// A map that slips to the left, by up to 2 m.
class SlippingMap : public LocalMapService {
 public:
  using LocalMapService::LocalMapService;
  const LocalMap& newest(std::int64_t now_ns) override {
    map_ = LocalMapService::newest(now_ns);
    slip_m_ = std::min(2.0, slip_m_ + 0.01);
    for (Lane& lane : map_.lanes) {
      for (Polyline* line : {&lane.left, &lane.right, &lane.centerline})
        for (Point& point : *line) point.y() += slip_m_;
    }
    return map_;
  }

 private:
  LocalMap map_;
  double slip_m_ = 0.0;
};

TEST(ClosedLoop, AWrongMapLeadsOutOfTheLaneAndThatIsSeen) {
  const simulation::Road road = simulation::make_scenario("straight");
  SlippingMap service{Config{}};
  ClosedLoop loop(road, {}, service);
  run(loop, 30.0);
  const DriveScore score = loop.score();
  ASSERT_FALSE(score.departures.empty());
  EXPECT_EQ(score.departures[0].how, LaneTracker::Verdict::changed_lane);
  EXPECT_FALSE(score.departures[0].guessed);
  EXPECT_NEAR(score.departures[0].place.y(), -1.5 * 3.5 + 1.75, 0.5);
  EXPECT_GT(score.lateral_m.quantile(1.0), 1.5);
  EXPECT_GE(score.border_crossings, 1U);
  EXPECT_EQ(score.restarts(), score.departures.size() + score.road_ends);
}

/// No map comes after `last_s`.
class BreakingMap : public LocalMapService {
 public:
  BreakingMap(const Config& config, double last_s) : LocalMapService(config), last_s_(last_s) {}
  const LocalMap& newest(std::int64_t now_ns) override {
    return static_cast<double>(now_ns) * 1e-9 > last_s_ ? none_ : LocalMapService::newest(now_ns);
  }

 private:
  double last_s_;
  LocalMap none_;
};

TEST(ClosedLoop, WithoutAMapItStandsAndThenCreepsOnAGuess) {
  const simulation::Road road = simulation::make_scenario("straight");
  BreakingMap service(Config{}, 0.0);
  ClosedLoop loop(road, {}, service);
  run(loop, 4.5);
  EXPECT_EQ(loop.driven_m(), 0.0);
  run(loop, 20.0);
  EXPECT_NEAR(loop.vehicle().speed_mps, 2.0, 1e-6);
  const DriveScore score = loop.score();
  ASSERT_EQ(score.guesses.size(), 1U);
  EXPECT_EQ(score.guesses[0].cause, Guess::Cause::no_lane);
  EXPECT_NEAR(score.guessed_m(), score.driven_m, 0.5);
}

TEST(ClosedLoop, WhenMapsStopItGoesOnByWhatItRemembersAndThenGuesses) {
  const simulation::Road road = simulation::make_scenario("straight");
  BreakingMap service(Config{}, 8.0);
  ClosedLoop loop(road, {}, service);
  run(loop, 14.0);
  const DriveScore score = loop.score();
  EXPECT_NEAR(score.remembered_m, 46.0, 8.0);  // what lay before the vehicle when the last map came
  EXPECT_GT(score.guessed_m(), 10.0);
  EXPECT_TRUE(score.departures.empty());
}

}  // namespace
}  // namespace laneloom::drive
