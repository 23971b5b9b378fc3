#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "laneloom/mapper.hpp"
#include "laneloom/polyline.hpp"
#include "simulation/motorways.hpp"
#include "simulation/perception.hpp"

/// Perfect detections where roads split and join: between them there is no lane.
namespace laneloom {
namespace {

constexpr double kFork_m = 155.0;      // where the lines of the gore meet
constexpr double kOnLane_m = 0.8;      // from the centre of a lane of the truth, at most
constexpr double kBesideFork_m = 3.0;  // within which the borders are hardly apart
constexpr double kRampSpeed_mps = 10.0;

struct Gore {
  std::string name;
  simulation::Road road;
  double sense;  ///< 1: the gore opens along x, -1: it closes
};

void PrintTo(const Gore& gore, std::ostream* out) { *out << gore.name; }

/// The same with the ramp on the other side of the road, but the same driving side.
simulation::Road other_side(simulation::Road road) {
  road = mirrored(std::move(road));
  road.right_hand_traffic = !road.right_hand_traffic;
  return road;
}

class NoLaneInAGore : public ::testing::TestWithParam<Gore> {};

TEST_P(NoLaneInAGore, IsPublished) {
  const simulation::Road road = GetParam().road;
  std::vector<MeasuredPolyline> truth;
  for (const simulation::RoadLane& lane : road.lanes) truth.emplace_back(lane.centerline);
  const auto off_lanes = [&](const Point& point) {
    return std::ranges::none_of(
        truth, [&](const MeasuredPolyline& lane) { return lane.project(point).distance_m < kOnLane_m; });
  };
  MapperConfig config;
  config.direction.driving_side = road.right_hand_traffic ? DrivingSide::right : DrivingSide::left;
  Mapper mapper(config);
  simulation::Perception perception(road, simulation::noise_profile("none"), simulation::SensorView{}, 1);
  std::size_t lanes_beside_gore = 0;
  for (int i = 1; i < static_cast<int>(road.drive.duration_s() * 10.0); ++i) {
    const VehiclePose pose = road.drive.pose_at(0.1 * i);
    for (const Lane& lane : mapper.update(perception.observe(pose), transform(pose)).lanes) {
      for (const Point& point : lane.centerline) {
        const double past_fork_m = GetParam().sense * (point.x() - kFork_m);
        if (past_fork_m < kBesideFork_m) continue;
        ++lanes_beside_gore;
        ASSERT_FALSE(off_lanes(point))
            << "frame " << i << " at " << pose.position.transpose() << ": lane " << lane.id << " at "
            << point.transpose() << ", width " << lane.width_m << ", " << lane.centerline.front().transpose()
            << " to " << lane.centerline.back().transpose();
      }
    }
  }
  EXPECT_GT(lanes_beside_gore, 1000U);
}

std::vector<Gore> gores() {
  std::vector<Gore> gores;
  for (const auto& [shape, ramp] :
       {std::pair{"wide_bend", simulation::Ramp{.radius_m = 700.0, .turn_deg = 9.0}},
        {"bend", simulation::Ramp{.radius_m = 300.0, .turn_deg = 14.0}},
        {"straight", simulation::Ramp{.radius_m = 20.0, .turn_deg = 4.0}},
        {"steep", simulation::Ramp{.radius_m = 20.0, .turn_deg = 8.0}}}) {
    const std::string name = shape;
    const simulation::Ramp driven{ramp.radius_m, ramp.turn_deg, true};
    gores.push_back({name + "_exit", exit_road(kRampSpeed_mps, ramp), 1.0});
    gores.push_back({name + "_exit_taken", exit_road(kRampSpeed_mps, driven), 1.0});
    gores.push_back({name + "_exit_on_the_left", other_side(exit_road(kRampSpeed_mps, ramp)), 1.0});
    gores.push_back({name + "_exit_in_left_hand_traffic", mirrored(exit_road(kRampSpeed_mps, ramp)), 1.0});
    gores.push_back({name + "_entry", entry_road(kRampSpeed_mps, ramp), -1.0});
    gores.push_back({name + "_entry_taken", entry_road(kRampSpeed_mps, driven), -1.0});
    gores.push_back({name + "_entry_on_the_left", other_side(entry_road(kRampSpeed_mps, ramp)), -1.0});
  }
  return gores;
}

INSTANTIATE_TEST_SUITE_P(Roads, NoLaneInAGore, ::testing::ValuesIn(gores()),
                         [](const auto& gore) { return gore.param.name; });

}  // namespace
}  // namespace laneloom
