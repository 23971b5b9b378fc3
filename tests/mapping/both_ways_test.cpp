#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "laneloom/lane_graph.hpp"
#include "mapping/mapped_road.hpp"

namespace laneloom {
namespace {

using test::Drive;

/// Where other vehicles drive: across the road, and which way along it.
struct Vehicle {
  double y_m = 0.0, speed_mps = -8.0;
};

/// The map after 30 m along a road with lines at these places across, on which others drive by, one after
/// the other.
LocalMap driven_among(const std::vector<Vehicle>& vehicles, const std::vector<double>& edges_m,
                      const std::vector<double>& lines_m = {}) {
  std::vector<Detection> road;
  const auto add = [&](MarkingType type, double y, MarkingStyle style) {
    road.push_back(test::detection(type, test::straight({-50, y, 0}, {300, y, 0}), style));
  };
  for (const double y : edges_m) add(MarkingType::roadedge, y, MarkingStyle::unknown);
  for (const double y : lines_m) add(MarkingType::laneline, y, MarkingStyle::dashed);
  Drive drive;
  for (int i = 0; i < 30; ++i) {
    TrackedObjects objects{.stamp_ns = (drive.number + 1) * 100'000'000LL, .in_map_frame = true};
    for (std::size_t k = 0; k < vehicles.size(); ++k) {
      const Vehicle& vehicle = vehicles[k];
      const double begin_x = vehicle.speed_mps < 0.0 ? 50.0 : 5.0;
      objects.objects.push_back({.id = k + 1,
                                 .kind = ObjectKind::car,
                                 .position = {begin_x + 0.1 * i * vehicle.speed_mps, vehicle.y_m, 0.0},
                                 .heading = {std::copysign(1.0, vehicle.speed_mps), 0.0, 0.0},
                                 .speed_mps = std::abs(vehicle.speed_mps)});
    }
    drive.mapper.add(objects, test::at(drive.x));
    drive.step(road);
  }
  return drive.mapper.map();
}

std::vector<Lane::Direction> directions(const LocalMap& map) {
  std::vector<Lane::Direction> told;
  for (const Lane& lane : map.lanes) told.push_back(lane.direction);
  return told;
}

TEST(BothWays, IsASingleLaneInWhichOthersComeTowardsTheVehicle) {
  const LocalMap map = driven_among({{}, {}}, {2.0, -2.0});
  ASSERT_THAT(directions(map), testing::ElementsAre(Lane::Direction::both));
  const Lane& lane = map.lanes.front();
  EXPECT_GT(lane.direction_probability, 0.7);
  EXPECT_EQ(lane.direction_evidence, Evidence::traffic | Evidence::ego_path);
  EXPECT_GT(lane.centerline.back().x(), lane.centerline.front().x()) << "it runs as the vehicle does";
  ASSERT_TRUE(map.way);
  EXPECT_FALSE(map.way->stations.empty());
}

TEST(BothWays, IsNoLaneWithOneVehicleThatComesByMistake) {
  EXPECT_THAT(directions(driven_among({{}}, {2.0, -2.0})),
              testing::ElementsAre(Lane::Direction::along_centerline));
}

TEST(BothWays, IsNoLaneInWhichAllDriveOneWay) {
  EXPECT_THAT(
      directions(driven_among({{.speed_mps = 8.0}, {.speed_mps = 9.0}, {.speed_mps = 10.0}}, {2.0, -2.0})),
      testing::ElementsAre(Lane::Direction::along_centerline));
}

TEST(BothWays, IsNoLaneBesideAnother) {
  for (const double y_m : {3.5, 0.0})  // in their own lane, and overtaking in the vehicle's
    EXPECT_THAT(directions(driven_among({{y_m}, {y_m}, {y_m}}, {5.25, -1.75}, {1.75})),
                testing::Each(testing::Ne(Lane::Direction::both)));
}

}  // namespace
}  // namespace laneloom
