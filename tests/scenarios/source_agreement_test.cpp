#include "session/source_agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "simulation/perception.hpp"
#include "simulation/scenarios.hpp"

/// Two networks on one road, each with errors of its own.
namespace laneloom::session {
namespace {

constexpr double kFrame_s = 0.1, kDuration_s = 30.0;

struct Pair {
  std::string scenario, noise, other_noise;
};

/// The frames of a drive in which a second source saw the lines elsewhere than the first, by what was told.
struct Told {
  int frames = 0, disagreeing = 0;
  double beside_m = 0.0;  ///< sum, to either side: lines at equal distances tell no side
};

/// Drives with a second source whose lines lie `left_m` further to the left.
Told drive(const Pair& pair, double left_m) {
  const simulation::Road road = simulation::make_scenario(pair.scenario);
  simulation::Perception first(road, simulation::noise_profile(pair.noise), simulation::SensorView{}, 1);
  simulation::Perception second(road, simulation::noise_profile(pair.other_noise), simulation::SensorView{},
                                2);
  SourceAgreement agreement{MapperConfig{}};
  Told told;
  for (double t_s = kFrame_s; t_s < std::min(kDuration_s, road.drive.duration_s()); t_s += kFrame_s) {
    const VehiclePose pose = road.drive.pose_at(t_s);
    DetectionFrame one = first.observe(pose), other = second.observe(pose);
    one.source = "first";
    other.source = "second";
    for (Detection& detection : other.detections)
      for (Point& point : detection.points) point.y() += left_m;
    EXPECT_TRUE(agreement.may_fuse(one, transform(pose), pose.stamp_ns));
    const bool agrees = agreement.may_fuse(other, transform(pose), pose.stamp_ns);
    EXPECT_EQ(agrees, agreement.disagreements().empty());
    ++told.frames;
    if (agrees) continue;
    ++told.disagreeing;
    told.beside_m += std::abs(agreement.disagreements().front().beside_m);
  }
  return told;
}

std::vector<Pair> pairs(const std::vector<std::string>& scenarios) {
  std::vector<Pair> all;
  for (const std::string& scenario : scenarios)
    for (const auto& [noise, other_noise] :
         {std::pair("none", "none"), {"inhouse", "inhouse"}, {"inhouse", "av2"}})
      all.push_back({scenario, noise, other_noise});
  return all;
}

TEST(SourceAgreementOnRoads, NetworksThatErrAsUsualAgree) {
  for (const Pair& pair : pairs(simulation::scenario_names())) {
    const Told told = drive(pair, 0.0);
    EXPECT_EQ(told.disagreeing, 0) << pair.scenario << " " << pair.noise << " " << pair.other_noise << " of "
                                   << told.frames;
  }
}

TEST(SourceAgreementOnRoads, OneWhoseLinesLieBesideIsTold) {
  for (const Pair& pair : pairs({"town", "street", "motorway", "curve"})) {
    for (const double left_m : {1.75, -1.0}) {
      const Told told = drive(pair, left_m);
      EXPECT_GT(told.disagreeing, 0.9 * told.frames)
          << pair.scenario << " " << pair.noise << " " << pair.other_noise << " by " << left_m;
      EXPECT_NEAR(told.beside_m / told.disagreeing, std::abs(left_m), 0.25);
    }
  }
}

// Padding, or what a network itself holds for a ghost.
TEST(SourceAgreementOnRoads, LinesThatNobodyTrustsContradictNothing) {
  const simulation::Road road = simulation::make_scenario("town");
  simulation::Perception first(road, simulation::noise_profile("none"), simulation::SensorView{}, 1);
  SourceAgreement agreement{MapperConfig{}};
  for (int i = 1; i < 50; ++i) {
    const VehiclePose pose = road.drive.pose_at(kFrame_s * i);
    DetectionFrame one = first.observe(pose), ghosts = one;
    one.source = "first";
    ghosts.source = "second";
    for (Detection& detection : ghosts.detections) {
      detection.confidence = 0.05;
      for (Point& point : detection.points) point.y() += 1.0;
    }
    EXPECT_TRUE(agreement.may_fuse(one, transform(pose), pose.stamp_ns));
    EXPECT_TRUE(agreement.may_fuse(ghosts, transform(pose), pose.stamp_ns));
  }
}

}  // namespace
}  // namespace laneloom::session
