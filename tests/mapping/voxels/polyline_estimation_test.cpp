#include "mapping/voxels/polyline_estimation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mapping/shapes.hpp"

namespace laneloom::voxels {
namespace {

using test::arc;
using test::max_distance;
using test::straight;

/// Voxel centres of a line that was seen with a lateral scatter, in random order.
std::vector<WeightedPoint> voxels_of(const Polyline& line, double scatter_m = 0.1) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> offset(-scatter_m, scatter_m);
  std::vector<WeightedPoint> points;
  for (const Point& p : MeasuredPolyline(line).resample(0.1)) {
    const Point seen = p + Point(offset(random), offset(random), 0.0);
    const Point center = ((seen.array() / 0.2).floor() + 0.5) * 0.2;
    points.push_back({center, 1.0});
  }
  std::ranges::shuffle(points, random);
  return points;
}

void expect_covers(const Polyline& line, const Polyline& truth, double tolerance_m) {
  EXPECT_LT(max_distance(line, truth), tolerance_m);
  EXPECT_LT(max_distance(MeasuredPolyline(truth).resample(1.0), line), tolerance_m);
}

TEST(PolylineEstimation, AStoplineHasTwoPoints) {
  const Polyline truth = straight({10, -3, 0}, {10, 4, 0});
  const Polyline line = estimate_polyline(voxels_of(truth), MarkingType::stopline, {});
  ASSERT_EQ(line.size(), 2U);
  expect_covers(line, truth, 0.25);
}

TEST(PolylineEstimation, AStraightLineIsDividedAlongTheFirstComponent) {
  const Polyline truth = straight({0, 0, 0}, {28, 14, 0});
  const Polyline line = estimate_polyline(voxels_of(truth), MarkingType::laneline, {});
  EXPECT_EQ(line.size(), 9U);  // 31.3 m in segments of about 4 m
  expect_covers(line, truth, 0.25);
}

TEST(PolylineEstimation, KeepsTheHeight) {
  const Polyline truth = straight({0, 0, 5}, {30, 0, 7.4});  // 8 %
  std::vector<WeightedPoint> points;
  for (const Point& p : MeasuredPolyline(truth).resample(0.1)) points.push_back({p, 1.0});
  for (const Point& p : estimate_polyline(points, MarkingType::laneline, {})) {
    EXPECT_NEAR(p.z(), 5 + 0.08 * p.x(), 0.01);
  }
}

// Paper, Fig. 4, bottom left: the quadrants of the first two components.
TEST(PolylineEstimation, ACornerOfAKerbIsFollowedByItsQuadrants) {
  const Polyline truth = arc({0, 0, 0}, 8, 0, 90);
  expect_covers(estimate_polyline(voxels_of(truth), MarkingType::roadedge, {}), truth, 0.35);
}

TEST(PolylineEstimation, ABendOfTwelveMetresWithItsStraights) {
  Polyline truth = straight({12, -15, 0}, {12, 0, 0}, 16);
  for (const Point& p : arc({0, 0, 0}, 12, 0, 90)) truth.push_back(p);
  for (const Point& p : straight({0, 12, 0}, {-15, 12, 0}, 16)) truth.push_back(p);
  expect_covers(estimate_polyline(voxels_of(truth), MarkingType::laneline, {}), truth, 0.35);
}

TEST(PolylineEstimation, AUTurn) {
  Polyline truth = straight({-15, -5, 0}, {0, -5, 0}, 16);
  for (const Point& p : arc({0, 0, 0}, 5, -90, 90)) truth.push_back(p);
  for (const Point& p : straight({0, 5, 0}, {-15, 5, 0}, 16)) truth.push_back(p);
  expect_covers(estimate_polyline(voxels_of(truth), MarkingType::roadedge, {}), truth, 0.5);
}

TEST(PolylineEstimation, AGapIsBridgedStraight) {
  auto points = voxels_of(straight({0, 0, 0}, {8, 0, 0}));
  const auto further = voxels_of(straight({20, 0, 0}, {28, 0, 0}));
  points.insert(points.end(), further.begin(), further.end());
  expect_covers(estimate_polyline(points, MarkingType::laneline, {}), straight({0, 0, 0}, {28, 0, 0}), 0.25);
}

TEST(PolylineEstimation, HeavierPointsPullTheLine) {
  std::vector<WeightedPoint> points;
  for (int i = 0; i < 40; ++i) {
    points.push_back({{0.1 * i, 0.0, 0.0}, 9.0});
    points.push_back({{0.1 * i, 0.2, 0.0}, 1.0});
  }
  for (const Point& p : estimate_polyline(points, MarkingType::laneline, {})) EXPECT_NEAR(p.y(), 0.02, 1e-9);
}

TEST(PolylineEstimation, DegenerateInstancesGiveNoNaN) {
  EXPECT_TRUE(estimate_polyline({{{1, 2, 3}, 1.0}}, MarkingType::laneline, {}).empty());
  for (const int count : {2, 5, 30}) {
    const std::vector<WeightedPoint> same(static_cast<std::size_t>(count), {{1, 2, 3}, 1.0});
    for (const MarkingType type : kMarkingTypes) {
      for (const Point& p : estimate_polyline(same, type, {})) EXPECT_TRUE(p.allFinite());
    }
  }
}

}  // namespace
}  // namespace laneloom::voxels
