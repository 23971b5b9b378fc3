#include "laneloom/polyline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "mapping/shapes.hpp"

namespace laneloom::geometry {
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

TEST(Polyline, RepeatedVerticesAreDropped) {
  Polyline line{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 5}, {1, 1e-10, 5}, {2, 0, 0}};
  const MeasuredPolyline measured(line);
  drop_repeats(line);
  EXPECT_EQ(line, measured.points());
  EXPECT_EQ(line, (Polyline{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
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

TEST(MeasuredPolyline, ChordsLeadFromOneArcLengthToAnother) {
  const MeasuredPolyline line({{0, 0, 0}, {3, 0, 5}, {3, 3, 0}});
  EXPECT_TRUE(line.chord(1.0, 2.0).isApprox(Eigen::Vector2d(1, 0)));
  EXPECT_TRUE(line.chord(-1.0, 7.0).isApprox(Eigen::Vector2d(1, 1).normalized()));
  EXPECT_TRUE(line.chord(5.0, 4.0).isApprox(Eigen::Vector2d(0, -1)));
  EXPECT_TRUE(line.chord(6.0, 8.0).isZero());
}

TEST(MeasuredPolyline, ResamplesBothEnds) {
  const Polyline samples = MeasuredPolyline(kCorner).resample(2.0);
  ASSERT_EQ(samples.size(), 5U);
  EXPECT_EQ(samples.front(), kCorner.front());
  EXPECT_EQ(samples.back(), kCorner.back());
}

TEST(Polyline, ResamplesAsAMeasuredOneDoes) {
  const Polyline repeating{{0, 0, 0}, {0, 0, 0}, {4, 0, 1}, {4, 0, 2}, {4, 3.3, 5}};
  EXPECT_EQ(resample(repeating, 0.7), MeasuredPolyline(repeating).resample(0.7));
  EXPECT_EQ(resample({{1, 1, 0}}, 2.0), (Polyline{{1, 1, 0}, {1, 1, 0}}));
}

TEST(Polyline, EndDirectionsPointOutwards) {
  EXPECT_TRUE(end_direction(kCorner, End::back).isApprox(Eigen::Vector2d(0, 1)));
  EXPECT_TRUE(end_direction(kCorner, End::front).isApprox(Eigen::Vector2d(-1, 0)));
  EXPECT_EQ(end_direction({{1, 1, 0}}, End::back), Eigen::Vector2d(0, 0));
}

TEST(Polyline, CosineAgreesWithTheMathematicalOne) {
  for (int deg = -360; deg <= 360; ++deg) {
    EXPECT_NEAR(cos_degrees(deg), std::cos(deg * std::numbers::pi / 180.0), 1e-15) << deg;
  }
}

/// Over all segments, one after the other.
Projection project_on_every_segment(const MeasuredPolyline& line, const Point& point) {
  const Polyline& points = line.points();
  const std::vector<double> arc = arc_lengths(points);
  Projection best;
  best.distance_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d along = (points[i + 1] - points[i]).head<2>(),
                          offset = (point - points[i]).head<2>();
    const double segment_m = arc[i + 1] - arc[i];
    const double share = offset.dot(along) / (segment_m * segment_m);
    const double clamped = std::clamp(share, 0.0, 1.0);
    const Point foot = points[i] + clamped * (points[i + 1] - points[i]);
    const double distance_m = (point - foot).head<2>().norm(), side = cross(along, offset) / segment_m;
    const bool beyond = (i == 0 && share < 0.0) || (i + 2 == points.size() && share > 1.0);
    if (distance_m >= best.distance_m) continue;
    best = {.arc_m = arc[i] + clamped * segment_m,
            .distance_m = distance_m,
            .lateral_m = beyond ? side : std::copysign(distance_m, side),
            .inside = !beyond,
            .segment = i,
            .foot = foot};
  }
  return best;
}

void expect_same(const Projection& a, const Projection& b) {
  EXPECT_EQ(a.arc_m, b.arc_m);
  EXPECT_EQ(a.distance_m, b.distance_m);
  EXPECT_EQ(a.lateral_m, b.lateral_m);
  EXPECT_EQ(a.inside, b.inside);
  EXPECT_EQ(a.segment, b.segment);
  EXPECT_EQ(a.foot, b.foot);
}

void expect_feet_as_on_every_segment(const Polyline& points, const std::vector<Point>& queries) {
  constexpr double kWithin_m = 3.0;
  const MeasuredPolyline line(points);
  for (const Point& query : queries) {
    const Projection expected = project_on_every_segment(line, query);
    const Projection foot = line.project(query), near = line.project(query, kWithin_m);
    expect_same(foot, expected);
    EXPECT_EQ(line.direction(foot), line.direction(foot.arc_m));
    if (expected.distance_m <= kWithin_m) {
      expect_same(near, expected);
    } else {
      EXPECT_EQ(near.distance_m, std::numeric_limits<double>::infinity());
      EXPECT_FALSE(near.inside);
    }
  }
}

/// Places on and about a line, some of them far from it.
std::vector<Point> places_about(const Polyline& line, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<Point> places;
  for (const Point& vertex : line) {
    for (const double spread_m : {0.0, 0.3, 4.0, 20.0})
      places.push_back(vertex + spread_m * Point(normal(random), normal(random), 0.0));
  }
  return places;
}

/// From nearly straight to winding about itself: its heading changes by `wobble_rad` from step to step, and
/// by `bend_rad` on the whole.
Polyline wander(double wobble_rad, double bend_rad, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  double heading_rad = 3.0 * normal(random);
  Polyline line{Point(1e4 * normal(random), 1e4 * normal(random), 0.0)};
  while (line.size() < 60) {
    heading_rad += bend_rad;
    const double angle_rad = heading_rad + wobble_rad * normal(random);
    line.push_back(line.back() + Point(std::cos(angle_rad), std::sin(angle_rad), 0.05 * normal(random)));
  }
  return line;
}

TEST(MeasuredPolyline, ProjectsAsOnEverySegmentToTheLastBit) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 20; ++round) {
    for (const double wobble_rad : {0.0, 0.02, 0.2, 0.8}) {
      for (const double bend_rad : {0.0, 0.01, 0.04, 0.15}) {
        const Polyline line = wander(wobble_rad, bend_rad, random);
        expect_feet_as_on_every_segment(line, places_about(line, random));
      }
    }
  }
}

TEST(MeasuredPolyline, ProjectsAsOnEverySegmentWhereMuchIsEquallyNear) {
  // On a lattice, points lie on vertices and in the middle between segments.
  std::mt19937_64 random(1);
  const auto snapped = [](Polyline points) {
    for (Point& point : points) point = 0.5 * (2.0 * point).array().round().matrix();
    return points;
  };
  for (int round = 0; round < 50; ++round) {
    for (const double bend_rad : {0.0, 0.04, 0.3}) {
      const Polyline line = snapped(wander(0.3, bend_rad, random));
      expect_feet_as_on_every_segment(line, snapped(places_about(line, random)));
    }
  }
}

TEST(MeasuredPolyline, ProjectsOnASinglePoint) {
  const MeasuredPolyline point(Polyline{{1, 2, 3}});
  EXPECT_DOUBLE_EQ(point.project({4, 6, 0}).distance_m, 5.0);
  EXPECT_EQ(point.project({4, 6, 0}, 4.0).distance_m, std::numeric_limits<double>::infinity());
}

TEST(Polyline, IntersectWhereTheyCrossOrTouch) {
  const Polyline line{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}};
  EXPECT_TRUE(intersect(line, {{8, 5, 3}, {12, 5, 3}}, 4));   // seen from above
  EXPECT_FALSE(intersect(line, {{8, 5, 3}, {12, 5, 3}}, 2));  // over it
  EXPECT_TRUE(intersect(line, {{5, 0, 0}, {5, 4, 0}}, 2));
  EXPECT_FALSE(intersect(line, {{5, 1, 0}, {9, 9, 0}}, 2));
  EXPECT_FALSE(intersect(line, {{2, 0, 0}, {4, 0, 0}}, 2));  // within it
}

}  // namespace
}  // namespace laneloom::geometry
