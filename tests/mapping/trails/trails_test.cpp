#include "mapping/trails/trails.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "milliseconds.hpp"

namespace laneloom::trails {
namespace {

using Change = std::function<void(TrackedObject&, int step)>;

/// A car that drives along x at 10 m/s, seen ten times a second from a vehicle that stands at x = -5, turned
/// to the left by a right angle.
class TrailsTest : public ::testing::Test {
 protected:
  static TrackedObject seen_at(double x, double y, double z = 0.0) {
    return {.id = 7,
            .kind = ObjectKind::car,
            .position = {y, -(x + 5.0), z},
            .heading = {0.0, -1.0, 0.0},
            .speed_mps = 10.0};
  }
  static Eigen::Isometry3d T_map_body() {
    return Eigen::Translation3d(-5.0, 0.0, 0.0) * Eigen::AngleAxisd(std::numbers::pi / 2.0, Point::UnitZ());
  }
  void drive(int from, int to, const Change& change = {}) {
    for (int step = from; step < to; ++step) {
      TrackedObject car = seen_at(static_cast<double>(step), 2.0);
      if (change) change(car, step);
      add(step, {car});
    }
  }
  void add(int step, std::vector<TrackedObject> objects) {
    trails_.add({.stamp_ns = (1000 + 100 * step) * kMs, .session_id = 1, .objects = std::move(objects)},
                T_map_body());
  }
  std::vector<std::size_t> sizes() const {
    std::vector<std::size_t> sizes;
    for (const Trail& trail : trails_.all()) sizes.push_back(trail.points.size());
    return sizes;
  }
  using Sizes = std::vector<std::size_t>;

  Trails trails_;
};

TEST_F(TrailsTest, AVehicleLeavesATrailInTheMapFrame) {
  drive(0, 20);
  ASSERT_EQ(sizes(), Sizes{20});
  EXPECT_NEAR((trails_.all()[0].points[13] - Point(13.0, 2.0, 0.0)).norm(), 0.0, 1e-9);
}

TEST_F(TrailsTest, ObjectsInTheMapFrameAreThoseOfTheBodyFrame) {
  TrackedObject car = seen_at(13.0, 2.0);
  car.position = {13.0, 2.0, 0.0};
  car.heading = Point::UnitX();
  const TrackedObjects seen = in_body_frame({.objects = {car}, .in_map_frame = true}, T_map_body());
  EXPECT_FALSE(seen.in_map_frame);
  EXPECT_TRUE(seen.objects[0].position.isApprox(seen_at(13.0, 2.0).position, 1e-9));
  EXPECT_TRUE(seen.objects[0].heading.isApprox(seen_at(13.0, 2.0).heading, 1e-9));
  EXPECT_EQ(in_body_frame({.objects = {car}}, T_map_body()).objects[0].position, car.position);
}

TEST_F(TrailsTest, PointsAreAMetreApart) {
  drive(0, 40, [](TrackedObject& car, int step) {
    car = seen_at(0.25 * step, 2.0);
    car.speed_mps = 2.5;
  });
  EXPECT_EQ(sizes(), Sizes{10});
}

TEST_F(TrailsTest, AFastVehicleThatIsSeenTwiceASecondLeavesNoGap) {
  for (int step = 0; step <= 20; step += 5) {
    TrackedObject car = seen_at(2.5 * step, 2.0 + 0.1 * step);
    car.speed_mps = 25.0;
    add(step, {car});
  }
  ASSERT_EQ(trails_.all().size(), 1U);
  const Polyline& points = trails_.all()[0].points;
  EXPECT_NEAR((points.front() - Point(0.0, 2.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((points.back() - Point(50.0, 4.0, 0.0)).norm(), 0.0, 1e-9);
  for (std::size_t i = 1; i < points.size(); ++i) {
    EXPECT_LE((points[i] - points[i - 1]).norm(), 5.0);
    EXPECT_NEAR(points[i].y(), 2.0 + 0.04 * points[i].x(), 1e-9) << "in a straight line";
  }
}

TEST_F(TrailsTest, TheOldestPointsOfALongTrailAreForgotten) {
  drive(-30, 54);
  ASSERT_EQ(sizes(), Sizes{64});
  EXPECT_NEAR(trails_.all()[0].points.back().x(), 53.0, 1e-9);
}

TEST_F(TrailsTest, WhatDoesNotDriveForwardsLeavesNone) {
  const std::vector<std::pair<const char*, Change>> none{
      {"parked", [](TrackedObject& car, int) { car.speed_mps = 0.9; }},
      {"reverses", [](TrackedObject& car, int) { car.speed_mps = -5.0; }},
      {"heading unknown", [](TrackedObject& car, int) { car.heading.setZero(); }},
      {"cyclist", [](TrackedObject& car, int) { car.kind = ObjectKind::bicycle; }},
      {"trailer", [](TrackedObject& car, int) { car.kind = ObjectKind::trailer; }},
      {"pedestrian", [](TrackedObject& car, int) { car.kind = ObjectKind::pedestrian; }},
      {"unknown", [](TrackedObject& car, int) { car.kind = ObjectKind::unknown; }},
      {"cyclist told as a car", [](TrackedObject& car, int) { car.width_m = 0.7; }},
      {"ghost", [](TrackedObject& car, int) { car.existence_probability = 0.4; }},
      {"vague", [](TrackedObject& car, int) { car.position_stddev_m = 1.5; }},
      {"far", [](TrackedObject& car, int) { car.position.x() = 70.0; }}};
  for (const auto& [what, change] : none) {
    trails_ = {};
    drive(0, 20, change);
    for (const std::size_t size : sizes()) EXPECT_EQ(size, 0U) << what;
  }
}

TEST_F(TrailsTest, AJumpBeginsANewTrail) {
  const auto from = [](int first, const std::function<void(TrackedObject&)>& change) {
    return [first, change](TrackedObject& car, int step) {
      if (step >= first) change(car);
    };
  };
  drive(0, 20, from(12, [](TrackedObject& car) { car.position.x() += 3.5; }));
  EXPECT_EQ(sizes(), (Sizes{12, 8})) << "of place";
  trails_ = {};
  drive(0, 20, from(12, [](TrackedObject& car) { car.position.x() += 2.5; }));
  EXPECT_EQ(sizes(), (Sizes{20})) << "a short one";
  trails_ = {};
  drive(0, 20, from(12, [](TrackedObject& car) { car.heading = {1.0, 0.0, 0.0}; }));
  EXPECT_EQ(sizes().front(), 12U) << "of heading";
  trails_ = {};
  drive(0, 20, from(12, [](TrackedObject& car) { car.id = 8; }));
  EXPECT_EQ(sizes(), (Sizes{12, 8})) << "of id";
  trails_ = {};
  drive(0, 10);
  drive(21, 30);
  EXPECT_EQ(sizes(), (Sizes{10, 9})) << "of stamp";
}

TEST_F(TrailsTest, AHeadingThatIsTheWrongWayRoundLeavesNoLongTrail) {
  drive(0, 20, [](TrackedObject& car, int) { car.heading = -car.heading; });
  EXPECT_EQ(sizes(), Sizes{1}) << "nor many short ones";
}

TEST_F(TrailsTest, AVehicleThatWaitsGoesOnWithItsTrail) {
  drive(0, 10);
  for (int step = 10; step < 40; ++step) {
    TrackedObject car = seen_at(9.0, 2.0);
    car.speed_mps = 0.0;
    add(step, {car});
  }
  for (int step = 40; step < 50; ++step) add(step, {seen_at(static_cast<double>(step - 30), 2.0)});
  EXPECT_EQ(sizes(), Sizes{20});
}

TEST_F(TrailsTest, AVehicleThatTwoTrackersFollowLeavesOneTrail) {
  const auto both = [&](int from, int to, double beside_m) {
    for (int step = from; step < to; ++step) {
      add(step, {seen_at(step, 2.0)});
      TrackedObject other = seen_at(step + 0.5, 2.0 + beside_m);
      other.id = 40;
      trails_.add({.stamp_ns = (1050 + 100 * step) * kMs, .session_id = 2, .objects = {other}}, T_map_body());
    }
  };
  both(0, 10, 0.8);
  EXPECT_EQ(sizes(), Sizes{10});
  for (int step = 10; step < 25; ++step) {  // the first one has lost it
    TrackedObject other = seen_at(step, 2.8);
    trails_.add({.stamp_ns = (1000 + 100 * step) * kMs, .session_id = 2, .objects = {other}}, T_map_body());
  }
  ASSERT_EQ(sizes().size(), 2U);
  EXPECT_EQ(trails_.all()[1].session, 2U);
  trails_ = {};
  both(0, 10, 2.5);
  EXPECT_EQ(sizes(), (Sizes{10, 10})) << "another one, in the lane beside";
}

TEST_F(TrailsTest, TheOrderWithinAMessageDoesNotMatter) {
  Trails other;
  for (int step = 0; step < 10; ++step) {
    TrackedObject car = seen_at(step, 2.0), second = seen_at(step, -2.0);
    second.id = 3;
    const TrackedObjects objects{.stamp_ns = (1 + step) * kMs * 100, .objects = {car, second}};
    const TrackedObjects reversed{.stamp_ns = objects.stamp_ns, .objects = {second, car}};
    trails_.add(objects, T_map_body());
    other.add(reversed, T_map_body());
  }
  ASSERT_EQ(other.all().size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(other.all()[i].object, trails_.all()[i].object);
    EXPECT_EQ(other.all()[i].points, trails_.all()[i].points);
  }
}

TEST_F(TrailsTest, WhatLiesFarBehindIsForgotten) {
  drive(0, 20);
  trails_.keep_around({70.0, 2.0, 0.0});
  EXPECT_EQ(sizes(), Sizes{10});
  drive(100, 101, [](TrackedObject& car, int) { car = seen_at(0.0, 9.0); });
  trails_.keep_around({200.0, 2.0, 0.0});
  ASSERT_EQ(trails_.all().size(), 1U) << "the first one was not seen for long";
  EXPECT_TRUE(trails_.all()[0].points.empty());
}

TEST_F(TrailsTest, AreBounded) {
  for (int step = 0; step < 10; ++step) {
    std::vector<TrackedObject> objects(256, seen_at(0.0, 2.0));
    for (std::size_t i = 0; i < objects.size(); ++i) objects[i].id = 256U * static_cast<unsigned>(step) + i;
    add(step, std::move(objects));
  }
  EXPECT_EQ(trails_.all().size(), 512U);
  EXPECT_EQ(trails_.all().back().object, 2559U) << "the newest stay";
}

TEST_F(TrailsTest, WhatTellsNothingIsForgottenFirst) {
  drive(0, 2);  // leaves a way
  const auto crowd = [&](int step, unsigned first_id) {
    std::vector<TrackedObject> objects(256, seen_at(0.0, -9.0));
    for (std::size_t i = 0; i < objects.size(); ++i) objects[i].id = first_id + i;
    add(step, std::move(objects));
  };
  crowd(20, 1000);
  crowd(40, 2000);
  ASSERT_EQ(trails_.all().size(), 512U);
  EXPECT_EQ(sizes().front(), 2U);
  EXPECT_EQ(trails_.all()[1].object, 1001U) << "it was seen a moment ago, and is followed no more";
}

}  // namespace
}  // namespace laneloom::trails
