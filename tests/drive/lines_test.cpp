#include "drive/lines.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "drive/steering.hpp"
#include "maps.hpp"

namespace laneloom::drive {
namespace {

TEST(Lines, SmoothingKeepsABendAndTakesNoiseAway) {
  const MeasuredPolyline arc(MeasuredPolyline(left_arc(10.0, 3.0)).resample(0.5));
  for (const Point& point : smoothed(arc.points())) EXPECT_NEAR((point - Point(0, 10, 0)).norm(), 10.0, 0.03);
  Polyline zigzag = MeasuredPolyline(straight_line({0, 0, 0}, {20, 0, 0})).resample(0.5);
  for (std::size_t i = 0; i < zigzag.size(); ++i) zigzag[i].y() = i % 2 == 0 ? 0.1 : -0.1;
  EXPECT_LT(std::abs(smoothed(zigzag)[20].y()), 0.03);
}

TEST(Lines, AppendingLeavesOutWhatOverlaps) {
  Polyline line{{0, 0, 0}, {10, 0, 0}};
  append(line, {{8, 0, 0}, {9, 0, 0}, {12, 0, 0}});
  EXPECT_EQ(line, (Polyline{{0, 0, 0}, {10, 0, 0}, {12, 0, 0}}));
  append(line, {{3, 0, 0}, {5, 0, 0}, {13, 0, 0}});
  EXPECT_EQ(line.back(), Point(13, 0, 0));
  EXPECT_DOUBLE_EQ(length(line), 13.0);
}

TEST(Lines, ProlongsABendWithACurvatureThatFades) {
  Polyline line = left_arc(20.0, 1.0);
  prolong(line, 30.0, 0.5);
  const MeasuredPolyline path(line);
  EXPECT_NEAR(path.length(), 50.0, 0.6);
  EXPECT_NEAR(curvature_at(path, 22.0), 0.05, 0.01);
  EXPECT_NEAR(curvature_at(path, 46.0), 0.0, 0.001);
}

TEST(Lines, ABendBetweenPerpendicularWaysIsNearlyAnArc) {
  const Polyline bend = bend_between({0, 0, 0}, {1, 0}, {10, 10, 0}, {0, 1});
  for (const Point& point : bend) EXPECT_NEAR((point - Point(0, 10, 0)).norm(), 10.0, 0.05);
}

TEST(Lines, BridgesGapsOnly) {
  const Polyline from{{0, 0, 0}, {5, 0, 0}};
  EXPECT_TRUE(bridge(from, {{6, 0, 0}, {9, 0, 0}}).empty());
  EXPECT_TRUE(bridge(from, {{2, 0, 0}, {9, 0, 0}}).empty());
  const Polyline across = bridge(from, {{15, 0, 0}, {19, 0, 0}});
  ASSERT_FALSE(across.empty());
  EXPECT_EQ(across.front(), Point(5, 0, 0));
  EXPECT_EQ(across.back(), Point(15, 0, 0));
}

TEST(Lines, ChangesOverBeforeTheEnd) {
  const Polyline line = straight_line({0, 0, 0}, {50, 0, 0}), other = straight_line({0, 3, 0}, {90, 3, 0});
  const MeasuredPolyline changed(change_over(line, other));
  EXPECT_NEAR(changed.project({10, 0, 0}).distance_m, 0.0, 1e-6);
  EXPECT_NEAR(changed.project({35, 1.5, 0}).distance_m, 0.0, 0.05);  // midway of the last 30 m
  EXPECT_NEAR(changed.project({80, 3, 0}).distance_m, 0.0, 1e-6);
}

}  // namespace
}  // namespace laneloom::drive
