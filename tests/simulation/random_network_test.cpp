#include "simulation/random_network.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "simulation/perception.hpp"
#include "simulation/scenarios.hpp"

namespace laneloom::simulation {
namespace {

TEST(RandomNetwork, IsTheSameForTheSameSeedOnly) {
  const NoiseProfile one = noise_profile("random:1"), again = noise_profile("random:1"),
                     two = noise_profile("random:2");
  EXPECT_EQ(one.name, "random:1");
  EXPECT_EQ(one.offset_stddev_far_m, again.offset_stddev_far_m);
  EXPECT_EQ(one.confidence_memory_s, again.confidence_memory_s);
  EXPECT_NE(one.offset_stddev_far_m, two.offset_stddev_far_m);
  EXPECT_FALSE(one.tells_view);
  EXPECT_TRUE(two.tells_view);
}

TEST(RandomNetwork, EveryOneGivesWellFormedFrames) {
  const Road road = make_scenario("straight");
  for (int seed = 1; seed <= 12; ++seed) {
    std::size_t detections = 0;
    Perception perception(road, noise_profile("random:" + std::to_string(seed)), SensorView{}, 1);
    for (int i = 0; i < 200; ++i) {
      const DetectionFrame frame = perception.observe(road.drive.pose_at(0.1 * i));
      detections += frame.detections.size();
      for (const Detection& detection : frame.detections) {
        EXPECT_GE(detection.points.size(), 2U);
        EXPECT_GE(detection.confidence, 0.0);
        EXPECT_LE(detection.confidence, 1.0);
        for (const Point& point : detection.points) EXPECT_TRUE(point.allFinite());
      }
    }
    EXPECT_GT(detections, 400U) << seed;
  }
}

TEST(RandomNetwork, ASeedThatIsNoneIsRefused) {
  for (const char* name :
       {"random", "random:", "random:x", "random:1x", "random:-1", "random:99999999999999999999"})
    EXPECT_THROW(noise_profile(name), std::invalid_argument) << name;
}

}  // namespace
}  // namespace laneloom::simulation
