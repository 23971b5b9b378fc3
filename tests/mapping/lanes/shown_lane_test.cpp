#include "mapping/lanes/shown_lane.hpp"

#include <gmock/gmock.h>

#include "laneloom/polyline.hpp"

namespace laneloom::lanes {
namespace {

/// Shown cross-sections 1 m apart along x.
class ShownLane : public ::testing::Test {
 protected:
  void add(double x, double left_y, double right_y) {
    LaneStation& station = track_.stations.emplace_back();
    station.border = {Point(x, left_y, 0), Point(x, right_y, 0)};
    station.shown = station.found = true;
  }
  Lane shown() const { return shown_lane(track_, boundaries::Boundaries()).value_or(Lane{}); }

  LaneTrack track_{.id = 1, .stations = {}};
};

TEST_F(ShownLane, HasBordersWithoutSpikes) {
  for (int i = 0; i < 20; ++i) add(i, i == 8 ? 0.7 : 1.7, -1.7);
  const Lane lane = shown();
  EXPECT_EQ(lane.left.size(), 19U);
  for (const Point& point : lane.left) EXPECT_EQ(point.y(), 1.7);
}

TEST_F(ShownLane, MayStepAside) {
  for (int i = 0; i < 20; ++i) add(i, i < 10 ? 1.7 : 3.2, -1.7);
  const Lane lane = shown();
  EXPECT_EQ(lane.left.front().y(), 1.7);
  EXPECT_EQ(lane.left.back().y(), 3.2);
  EXPECT_GE(lane.left.size(), 19U);
}

TEST_F(ShownLane, HasItsCenterlineWithinWhereANarrowLaneBecomesAWideOne) {
  for (int i = 0; i < 20; ++i) add(i, i < 10 ? 1.0 : 7.0, -1.0);
  track_.stations[9].stepped = true;
  const Lane lane = shown();
  const MeasuredPolyline left(lane.left);
  ASSERT_FALSE(lane.centerline.empty());
  for (const Point& point : lane.centerline)
    EXPECT_LT(left.project(point).lateral_m, 0.0) << point.transpose();
}

}  // namespace
}  // namespace laneloom::lanes
