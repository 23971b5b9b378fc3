#include "bench/scale.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/scenarios.hpp"

namespace laneloom::bench {
namespace {

using testing::ElementsAre;

TEST(Multiplied, CopiesLieSideBySideInTheRange) {
  DetectionFrame frame;
  frame.sequence = 5;
  frame.detections = {Detection{.points = {{0, 10, 1}, {20, 12, 1}}}};
  EXPECT_EQ(multiplied(frame, 1, 15.0).detections.size(), 1U);
  const DetectionFrame more = multiplied(frame, 3, 15.0);  // displaced by 10 m each
  EXPECT_EQ(more.sequence, 5U);
  ASSERT_EQ(more.detections.size(), 3U);
  EXPECT_THAT(more.detections[0].points, ElementsAre(Point(0, 10, 1), Point(20, 12, 1)));
  EXPECT_THAT(more.detections[1].points, ElementsAre(Point(0, -10, 1), Point(20, -8, 1)));  // round the edge
  EXPECT_THAT(more.detections[2].points, ElementsAre(Point(0, 0, 1), Point(20, 2, 1)));
}

TEST(Scaled, ToEverySide) {
  const RangeConfig range = scaled(RangeConfig{}, 4.0);
  EXPECT_DOUBLE_EQ(range.forward_min_m, -20.0);
  EXPECT_DOUBLE_EQ(range.forward_max_m, 120.0);
  EXPECT_DOUBLE_EQ(range.side_max_m, 60.0);
  const simulation::SensorView view = scaled(simulation::SensorView{}, 2.0);
  EXPECT_DOUBLE_EQ(view.forward_max_m, 100.0);
  EXPECT_DOUBLE_EQ(view.side_max_m, 40.0);
}

TEST(DriveMinutes, HaveSixHundredFramesEach) {
  const experiment::DriveSpec drive{
      .road = std::make_shared<const simulation::Road>(simulation::make_scenario("straight")),
      .noise = simulation::noise_profile("none")};
  std::vector<std::size_t> minutes, frames;
  drive_minutes(MapperConfig{}, drive, 2, [&](const MinuteCost& minute) {
    minutes.push_back(minute.minute);
    frames.push_back(minute.cost.update_ms.size());
    EXPECT_GT(minute.rss_mb, 1.0);
  });
  EXPECT_THAT(minutes, ElementsAre(1, 2));
  EXPECT_THAT(frames, ElementsAre(600, 600));
}

TEST(Standing, StaysWhereTheDriveIsThen) {
  const simulation::Road road = simulation::make_scenario("straight", 10.0);
  const VehiclePose there = road.drive.pose_at(3.0);
  experiment::DriveSimulation simulation(
      {.road = std::make_shared<const simulation::Road>(standing(road, 3.0))});
  for (int i = 1; i <= 20; ++i) {
    const experiment::SimulatedFrame frame = simulation.next();
    EXPECT_EQ(frame.record.pose.position, there.position);
    EXPECT_EQ(frame.record.frame.stamp_ns, i * 100'000'000);
    EXPECT_FALSE(frame.record.frame.detections.empty());
  }
}

TEST(TimeVehicles, HasAllTheirUpdates) {
  const auto frames = experiment::simulate(
      {.road = std::make_shared<const simulation::Road>(simulation::make_scenario("straight")),
       .duration_s = 1.0});
  EXPECT_GT(time_vehicles(MapperConfig{}, frames, 3).max_ms, 0.0);
}

}  // namespace
}  // namespace laneloom::bench
