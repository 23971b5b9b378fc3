#include "laneloom/polyline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mapping/shapes.hpp"

namespace laneloom {
namespace {

const Polyline kCorner{{0, 0, 0}, {3, 0, 1}, {3, 4, 2}};

TEST(Polyline, ArcLengthsAreHorizontal) {
  EXPECT_EQ(arc_lengths(kCorner), (std::vector<double>{0.0, 3.0, 7.0}));
  EXPECT_DOUBLE_EQ(length(kCorner), 7.0);
  EXPECT_DOUBLE_EQ(length({}), 0.0);
}

TEST(MeasuredPolyline, InterpolatesAndClamps) {
  const MeasuredPolyline line(kCorner);
  EXPECT_EQ(line.at(-1.0), Point(0, 0, 0));
  EXPECT_TRUE(line.at(1.5).isApprox(Point(1.5, 0, 0.5)));
  EXPECT_TRUE(line.at(5.0).isApprox(Point(3, 2, 1.5)));
  EXPECT_EQ(line.at(9.0), Point(3, 4, 2));
}

TEST(MeasuredPolyline, LeavesOutRepeatedVertices) {
  const MeasuredPolyline line({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 5}});
  EXPECT_EQ(line.points().size(), 2U);
  EXPECT_TRUE(line.direction(0.5).isApprox(Eigen::Vector2d(1, 0)));
}

TEST(MeasuredPolyline, ProjectsWithSide) {
  const MeasuredPolyline line(kCorner);
  const Projection left = line.project({1, 2, 9});
  EXPECT_DOUBLE_EQ(left.arc_m, 1.0);
  EXPECT_DOUBLE_EQ(left.distance_m, 2.0);
  EXPECT_DOUBLE_EQ(left.lateral_m, 2.0);
  EXPECT_TRUE(left.inside);
  const Projection right = line.project({5, 3, 0});
  EXPECT_DOUBLE_EQ(right.arc_m, 6.0);
  EXPECT_DOUBLE_EQ(right.lateral_m, -2.0);
  EXPECT_EQ(right.segment, 1U);
}

TEST(MeasuredPolyline, BeyondAnEndTheLateralIsFromTheExtension) {
  const Projection foot = MeasuredPolyline(kCorner).project({-3, -4, 0});
  EXPECT_FALSE(foot.inside);
  EXPECT_DOUBLE_EQ(foot.distance_m, 5.0);
  EXPECT_DOUBLE_EQ(foot.lateral_m, -4.0);
  EXPECT_DOUBLE_EQ(foot.arc_m, 0.0);
}

TEST(MeasuredPolyline, SlicesWithInnerVertices) {
  const Polyline part = MeasuredPolyline(kCorner).slice({1.0, 5.0});
  ASSERT_EQ(part.size(), 3U);
  EXPECT_EQ(part[1], Point(3, 0, 1));
  EXPECT_DOUBLE_EQ(length(part), 4.0);
}

TEST(MeasuredPolyline, ResamplesBothEnds) {
  const Polyline samples = MeasuredPolyline(kCorner).resample(2.0);
  ASSERT_EQ(samples.size(), 5U);
  EXPECT_EQ(samples.front(), kCorner.front());
  EXPECT_EQ(samples.back(), kCorner.back());
}

TEST(Polyline, EndDirectionsPointOutwards) {
  EXPECT_TRUE(end_direction(kCorner, true).isApprox(Eigen::Vector2d(0, 1)));
  EXPECT_TRUE(end_direction(kCorner, false).isApprox(Eigen::Vector2d(-1, 0)));
  EXPECT_EQ(end_direction({{1, 1, 0}}, true), Eigen::Vector2d(0, 0));
}

TEST(Polyline, CosineAgreesWithTheMathematicalOne) {
  for (int deg = -360; deg <= 360; ++deg) {
    EXPECT_NEAR(cos_degrees(deg), std::cos(deg * std::numbers::pi / 180.0), 1e-15) << deg;
  }
}

TEST(MeasuredPolyline, ProjectOnTheNearestOfAllSegments) {
  // A spiral comes near a point again and again.
  Polyline line;
  for (int i = 0; i < 400; ++i) {
    const double angle = 0.1 * i, radius_m = 30.0 - 0.05 * i;
    line.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.01 * i);
  }
  const MeasuredPolyline measured(line);
  for (double x = -35.0; x <= 35.0; x += 3.1) {
    for (double y = -35.0; y <= 35.0; y += 2.7) {
      double nearest_m = 1e9;
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const MeasuredPolyline segment(Polyline{line[i], line[i + 1]});
        nearest_m = std::min(nearest_m, segment.project({x, y, 0}).distance_m);
      }
      EXPECT_NEAR(measured.project({x, y, 0}).distance_m, nearest_m, 1e-9);
    }
  }
}

TEST(Polyline, IntersectWhereTheyCrossOrTouch) {
  const Polyline line{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}};
  EXPECT_TRUE(intersect(line, {{8, 5, 3}, {12, 5, 3}}));  // seen from above
  EXPECT_TRUE(intersect(line, {{5, 0, 0}, {5, 4, 0}}));
  EXPECT_FALSE(intersect(line, {{5, 1, 0}, {9, 9, 0}}));
  EXPECT_FALSE(intersect(line, {{2, 0, 0}, {4, 0, 0}}));  // within it
}

}  // namespace
}  // namespace laneloom
