#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "mapping/lanes/ways.hpp"

/// A way is a line that a vehicle can drive.
namespace laneloom::lanes {
namespace {

using test::largest_curvature_per_m;
using test::largest_kink_deg;
using test::link;
using test::points;
using test::road_lane;
using test::straight;
using test::way_on;
using Turn = Linkage::Turn;

TEST(Way, CutsNoBend) {
  LocalMap map;
  Polyline road = straight({-30, -12, 0}, {0, -12, 0}, 31);
  const Polyline bend = test::arc({0, 0, 0}, 12.0, -90, 90), out = straight({-1, 12, 0}, {-30, 12, 0}, 30);
  road.insert(road.end(), bend.begin(), bend.end());
  road.insert(road.end(), out.begin(), out.end());
  map.lanes = {road_lane(1, road)};
  const Way way = way_on(map, test::at(-10, -12));
  ASSERT_GT(way.length(), 59.0);
  EXPECT_LT(test::max_distance(points(way), road), 0.05);
  EXPECT_NEAR(way.stations[29].curvature_per_m, 1.0 / 12.0, 0.003);
  EXPECT_LT(largest_curvature_per_m(way), 1.25 / 12.0);
}

TEST(Way, BridgesAGapAndAStepWithoutAKink) {
  LocalMap map;
  map.lanes = {road_lane(1, {0, 0, 0}, {40, 0, 0}), road_lane(2, {41, 0.2, 0}, {100, 0.2, 0})};
  map.linkages = {link(1, 2)};
  for (const double x : {10.0, 38.0, 40.5, 42.0}) {
    const Way way = way_on(map, test::at(x));
    ASSERT_GT(way.length(), 50.0) << x;
    EXPECT_NEAR(way.stations.back().point.y(), 0.2, 0.01);
    EXPECT_LT(largest_kink_deg(way, 2.0), 3.0);
    EXPECT_LT(largest_curvature_per_m(way), 0.02);
    EXPECT_EQ(way.confirmed_m, way.known_m) << "nothing is doubtful about a short gap";
  }
  EXPECT_NEAR(way_on(map, test::at(10)).stations.front().point.y(), 0.0, 0.01);
}

/// A corner that no vehicle can drive is an error of the map.
TEST(Way, EndsBeforeACornerThatIsTighterThanAnyVehicleDrives) {
  for (const double radius_m : {1.0, 6.0}) {
    const Point center(20, radius_m, 0);
    LocalMap map;
    map.lanes = {road_lane(1, {0, 0, 0}, {20, 0, 0}),
                 road_lane(2, {20 + radius_m, radius_m, 0}, {20 + radius_m, 40, 0})};
    map.linkages = {link(1, 2, Turn::left, test::arc(center, radius_m, -90, 0))};
    const Way way = way_on(map, test::at(0), WayWish::left);
    EXPECT_LT(largest_curvature_per_m(way), 0.4);
    EXPECT_EQ(way.length() < 20.0 + radius_m, radius_m < 2.0) << way.length();
    EXPECT_GT(way.length(), 15.0);
  }
}

/// Curvatures over chords of 5 m.
std::vector<double> chord_curvatures_per_m(const Way& way) {
  std::vector<double> result;
  for (std::size_t i = 0; i + 10 < way.stations.size(); ++i) {
    const Eigen::Vector2d in = (way.stations[i + 5].point - way.stations[i].point).head<2>(),
                          out = (way.stations[i + 10].point - way.stations[i + 5].point).head<2>();
    result.push_back(std::abs(cross(in.normalized(), out.normalized())) / 5.0);
  }
  return result;
}

TEST(Way, IsSmoothOnNoisyRoads) {
  std::mt19937 random(7);  // gives the same numbers everywhere
  const auto noise_m = [&] {
    double sum = 0.0;  // nearly normal
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / 4294967296.0 - 0.5;
    return 0.05 * sum;
  };
  std::vector<double> curvatures_per_m;
  for (int road = 0; road < 40; ++road) {
    LocalMap map;
    Polyline line;
    for (int x = 0; x <= 100; ++x) line.emplace_back(x, noise_m(), 0.0);
    map.lanes = {road_lane(1, line)};
    const Way way = way_on(map, test::at(20));
    ASSERT_EQ(way.stations.size(), 61U);
    for (std::size_t i = 1; i < way.stations.size(); ++i) {
      const double step_m = (way.stations[i].point - way.stations[i - 1].point).head<2>().norm();
      EXPECT_NEAR(step_m, way.step_m, 0.01);
    }
    EXPECT_LT(largest_kink_deg(way, 1.0), 0.5);
    EXPECT_LT(largest_curvature_per_m(way), 0.006);
    const std::vector<double> more = chord_curvatures_per_m(way);
    curvatures_per_m.insert(curvatures_per_m.end(), more.begin(), more.end());
  }
  std::ranges::sort(curvatures_per_m);
  EXPECT_LT(curvatures_per_m[curvatures_per_m.size() * 99 / 100], 0.002);
  RecordProperty("p99_per_m", std::to_string(curvatures_per_m[curvatures_per_m.size() * 99 / 100]));
}

}  // namespace
}  // namespace laneloom::lanes
