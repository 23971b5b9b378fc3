#include "drive/lines.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "drive/steering.hpp"
#include "maps.hpp"

namespace laneloom::drive {
namespace {

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

}  // namespace
}  // namespace laneloom::drive
