#include "drive/steering.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "maps.hpp"

namespace laneloom::drive {
namespace {

constexpr double kStep_s = 0.01;

TEST(Bicycle, DrivesTheCircleOfItsSteeringAngle) {
  Bicycle vehicle{.speed_mps = 5.0, .steering_rad = 0.2};
  const double radius_m = 2.8 / std::tan(0.2);  // 13.81 m, about (0, radius)
  const double round_s = 2.0 * std::numbers::pi * radius_m / 5.0;
  double turned_rad = 0.0;
  for (int i = 0; i < static_cast<int>(std::lround(round_s / kStep_s)); ++i) {
    const double before = vehicle.heading_rad;
    vehicle.step({.steering_rad = 0.2, .speed_mps = 5.0}, kStep_s);
    turned_rad += vehicle.heading_rad - before;
    EXPECT_NEAR((vehicle.rear_axle - Eigen::Vector2d(0.0, radius_m)).norm(), radius_m, 1e-3);
  }
  EXPECT_NEAR(turned_rad, 2.0 * std::numbers::pi, 0.01);
  EXPECT_NEAR(vehicle.rear_axle.norm(), 0.0, 0.05);
}

TEST(Bicycle, SteersAndSpeedsNoFasterThanItCan) {
  Bicycle vehicle;
  for (int i = 0; i < 50; ++i) vehicle.step({.steering_rad = 2.0, .speed_mps = 30.0}, kStep_s);
  EXPECT_NEAR(vehicle.steering_rad, 0.3, 1e-9);  // 0.6 rad/s for 0.5 s
  EXPECT_NEAR(vehicle.speed_mps, 0.75, 1e-9);    // 1.5 m/s^2
  for (int i = 0; i < 200; ++i) vehicle.step({.steering_rad = 2.0, .speed_mps = 30.0}, kStep_s);
  EXPECT_NEAR(vehicle.steering_rad, 0.6, 1e-9);
  for (int i = 0; i < 1000; ++i) vehicle.step({.steering_rad = 0.0, .speed_mps = -5.0}, kStep_s);
  EXPECT_EQ(vehicle.speed_mps, 0.0);
}

TEST(Steering, KnowsTheCurvatureOfAnArc) {
  const MeasuredPolyline arc(left_arc(15.0, 2.0));
  EXPECT_NEAR(curvature_at(arc, 10.0), 1.0 / 15.0, 0.002);
  Polyline right = arc.points();
  for (Point& point : right) point.y() = -point.y();
  EXPECT_NEAR(curvature_at(MeasuredPolyline(right), 10.0), -1.0 / 15.0, 0.002);
}

struct Course {
  double last_m = 0.0;       ///< offset from the path
  double overshoot_m = 0.0;  ///< to the other side of the path than the vehicle began on
};

/// From `offset_m` left of the path's begin.
Course drive(const Polyline& line, double offset_m, double speed_mps, double duration_s) {
  const MeasuredPolyline path(line);
  Bicycle vehicle{.rear_axle = {0.0, offset_m}, .speed_mps = speed_mps};
  Course course;
  for (int i = 0; i < static_cast<int>(duration_s / kStep_s); ++i) {
    vehicle.step(follow(path, vehicle, speed_mps), kStep_s);
    course.last_m = path.project({vehicle.rear_axle.x(), vehicle.rear_axle.y(), 0.0}).lateral_m;
    course.overshoot_m = std::max(course.overshoot_m, -std::copysign(1.0, offset_m) * course.last_m);
  }
  return course;
}

TEST(Steering, ConvergesOnAStraight) {
  const Polyline line = straight_line({-5, 0, 0}, {400, 0, 0});
  for (const double speed_mps : {2.0, 5.0, 10.0, 20.0}) {
    const Course course = drive(line, 1.0, speed_mps, 15.0);
    EXPECT_NEAR(course.last_m, 0.0, 0.01) << speed_mps;
    EXPECT_LT(course.overshoot_m, 0.05) << speed_mps;
  }
}

TEST(Steering, ConvergesOnABendOf15Metres) {
  for (const double offset_m : {1.0, -1.0}) {
    const Course course = drive(left_arc(15.0, 6.0), offset_m, 5.0, 10.0);
    EXPECT_NEAR(course.last_m, 0.0, 0.05) << offset_m;
    EXPECT_LT(course.overshoot_m, 0.15) << offset_m;
  }
}

TEST(Steering, SlowsDownBeforeABend) {
  Polyline line = straight_line({-100, 0, 0}, {-1, 0, 0});
  const Polyline arc = left_arc(15.0, 3.0);
  line.insert(line.end(), arc.begin(), arc.end());
  const MeasuredPolyline path(line);
  const Bicycle in_bend{.rear_axle = arc[20].head<2>(), .speed_mps = 10.0};
  EXPECT_NEAR(follow(path, in_bend, 10.0).speed_mps, std::sqrt(2.0 * 15.0), 0.2);  // 2 m/s^2
  const Bicycle before{.rear_axle = {-10.0, 0.0}, .speed_mps = 10.0};
  EXPECT_NEAR(follow(path, before, 10.0).speed_mps, std::sqrt(2.0 * 15.0 + 2.0 * 1.5 * 10.0), 0.4);
  const Bicycle far{.rear_axle = {-90.0, 0.0}, .speed_mps = 10.0};
  EXPECT_EQ(follow(path, far, 10.0).speed_mps, 10.0);
}

}  // namespace
}  // namespace laneloom::drive
