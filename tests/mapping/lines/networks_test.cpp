#include "mapping/lines/networks.hpp"

#include <gtest/gtest.h>

#include "laneloom/error.hpp"

namespace laneloom::lines {
namespace {

TEST(Standpoint, ViewsFromOnePlaceAreTogetherLessThanTwo) {
  Standpoint standpoint;
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) sum += standpoint.news({5, 5, 0}, i);
  EXPECT_LT(sum, 2.0);
}

TEST(Standpoint, EveryNewPlaceIsAnIndependentView) {
  Standpoint standpoint;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(standpoint.news({0.5 * i, 0, 0}, i), 1.0);
}

TEST(Standpoint, AfterTwoSecondsFromOnePlaceAViewASecondIsTaken) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  Standpoint standpoint;
  std::vector<int> taken;
  int at = 0;
  for (; at < 60; ++at) {
    if (standpoint.has_seen({0.1, 0, 0}, at * kSecond / 10)) continue;
    standpoint.news({0.1, 0, 0}, at * kSecond / 10);
    taken.push_back(at);
    EXPECT_EQ(standpoint.least_news(), at < 20 ? 0.3 : 1.0);
  }
  EXPECT_EQ(taken.size(), 24U);
  EXPECT_EQ(taken.back(), 59);
  EXPECT_TRUE(standpoint.has_seen({0.1, 0, 0}, 6 * kSecond));
  EXPECT_FALSE(standpoint.has_seen({0.5, 0, 0}, 6 * kSecond)) << "the vehicle has moved";
  EXPECT_FALSE(standpoint.has_seen({0.1, 0, 0}, kSecond)) << "the clock was set back";
}

TEST(Standpoint, AViewRightAfterAnotherOneTellsLittleForHoweverLongTheVehicleStands) {
  Standpoint standpoint;
  for (int i = 0; i < 60; ++i) {
    standpoint.news({5, 5, 0}, std::int64_t{i} * 100'000'000);
    EXPECT_EQ(standpoint.least_news(), 0.3) << i;
  }
  standpoint.news({5, 5, 0}, 7'000'000'000);
  EXPECT_EQ(standpoint.least_news(), 1.0);
}

TEST(Networks, EachSourceHasItsOwn) {
  Networks networks;
  const auto front = networks.number("front", 1, {}), rear = networks.number("rear", 2, {});
  EXPECT_NE(front, rear);
  EXPECT_EQ(networks.number("front", 3, {}), front);
  EXPECT_EQ(networks.find("front"), &networks[front]);
  EXPECT_EQ(networks.find("side"), nullptr);
}

TEST(Networks, TheOneThatWasNotHeardOfForLongestIsForgotten) {
  Networks networks;
  for (int i = 0; i < 8; ++i) networks.number(std::to_string(i), static_cast<std::uint64_t>(i + 1), {});
  networks.number("0", 9, {});
  networks.number("another", 10, {});
  EXPECT_NE(networks.find("0"), nullptr);
  EXPECT_EQ(networks.find("1"), nullptr);
  EXPECT_NE(networks.find("another"), nullptr);
}

TEST(PitchHistory, TellsWhatIsNewFromWhatLasts) {
  PitchHistory pitch;
  EXPECT_EQ(pitch.parts(0.002).sudden_per_m, 0.002);
  for (int i = 0; i < 30; ++i) pitch.parts(0.002);
  EXPECT_NEAR(pitch.parts(0.002).sudden_per_m, 0.0, 1e-5);
  EXPECT_NEAR(pitch.parts(0.005).sudden_per_m, 0.003, 1e-5);
  for (int i = 0; i < 30; ++i) pitch.parts(0.002);
  EXPECT_NEAR(pitch.parts(0.005).lasting_per_m, 0.002, 1e-5);
}

TEST(PitchHistory, MostOfATaperIsNoPitch) {
  PitchHistory pitch;
  for (int i = 0; i < 30; ++i) pitch.parts(-0.010);
  const PitchParts taper = pitch.parts(-0.010);
  EXPECT_NEAR(taper.sudden_per_m, 0.0, 1e-5);
  EXPECT_EQ(taper.lasting_per_m, -0.003);
}

TEST(Networks, StartsWithWhatTheProfileOfASourceKnows) {
  MapperConfig config;
  config.networks["front"] = {{"stddev_at_26_m", {0.4, 1000}},
                              {"pitch_gain", {0.8, 900}},
                              {"lasting_pitch_gain", {0.6, 400}},
                              {"rate_roadedge_behind_10_m", {0.5, 700}},
                              {"confidence", {0.3, 60}}};
  Networks networks;
  const Network front = networks[networks.number("front", 1, config)];
  EXPECT_NEAR(front.lateral.stddev_m(26.0), 0.4, 1e-12);
  EXPECT_NEAR(front.lateral.gains()[kSuddenPitch], 0.8, 1e-12);
  EXPECT_NEAR(front.lateral.gains()[kLastingPitch], 0.6, 1e-12);
  EXPECT_EQ(front.detection.rate(MarkingType::roadedge, {-15, 0, 0}), 0.5);
  EXPECT_NEAR(front.detection.belief(0.3), kUsualBelief, 1e-12);
  EXPECT_EQ(front.lateral.stddev_m(8.0), NetworkModel(config.fusion).stddev_m(8.0)) << "not in the profile";

  const Network rear = networks[networks.number("rear", 2, config)];
  EXPECT_EQ(rear.lateral.gains(), PerSuspicion::Zero()) << "a profile is of one source";
}

TEST(Networks, AProfileGivesTheSameNetworkAgain) {
  MapperConfig config;
  Networks networks;
  Network& taught = networks[networks.number("front", 1, config)];
  for (int i = 0; i < 500; ++i) {
    const FarView view{.source = 0, .range_m = 20.0, .lateral_m = 0.1, .suspected_m = {0.08, 0.02, 0.0}};
    taught.lateral.learn(view, 0.0);
    taught.detection.learn_rate(MarkingType::laneline, {12, 0, 0}, i % 3 != 0);
    taught.detection.learn_confidence(0.8);
  }
  config.networks["front"] = taught.profile();
  Networks again;
  const NetworkProfile profile = again[again.number("front", 1, config)].profile();
  ASSERT_EQ(profile.size(), taught.profile().size());
  for (const auto& [name, learned] : taught.profile()) {
    EXPECT_NEAR(profile.at(name).value, learned.value, 1e-9) << name;
    EXPECT_NEAR(profile.at(name).weight, learned.weight, 1e-9) << name;
  }
}

TEST(Networks, AProfileWithAnUnknownValueIsRefused) {
  MapperConfig config;
  config.fusion.profile_file = "network.yaml";
  config.networks["front"] = {{"stddev_at_27_m", {0.4, 1000}}};
  try {
    check_profiles(config);
    FAIL() << "it was taken";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "network.yaml: front.stddev_at_27_m is not a value that is learned of a network");
  }
}

}  // namespace
}  // namespace laneloom::lines
