#include "ros2/tracked_objects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "bytes.hpp"
#include "read.hpp"
#include "ros2/input.hpp"

namespace laneloom::ros2 {
namespace {

using autoware_perception_msgs::msg::dds_::ObjectClassification_;
using autoware_perception_msgs::msg::dds_::TrackedObject_;
using autoware_perception_msgs::msg::dds_::TrackedObjects_;

ObjectClassification_ classified(std::uint8_t label, float probability) {
  ObjectClassification_ classification;
  classification.label(label);
  classification.probability(probability);
  return classification;
}

/// A truck that drives along y of the map.
TrackedObject_ truck() {
  TrackedObject_ object;
  object.object_id().uuid()[3] = 9;
  object.existence_probability(0.75F);
  object.classification({classified(1, 0.25F), classified(2, 0.5F), classified(5, 0.125F)});
  auto& kinematics = object.kinematics();
  auto& pose = kinematics.pose_with_covariance();
  pose.pose().position().x(20.0);
  pose.pose().position().y(30.0);
  pose.pose().position().z(3.5);
  pose.pose().orientation().z(std::sqrt(0.5));
  pose.pose().orientation().w(std::sqrt(0.5));
  pose.covariance()[0] = 0.04;
  pose.covariance()[7] = 0.09;
  kinematics.twist_with_covariance().twist().linear().x(8.0);
  kinematics.orientation_availability(2);
  object.shape().dimensions().x(9.0);
  object.shape().dimensions().y(2.5);
  object.shape().dimensions().z(3.0);
  return object;
}

TrackedObjects_ message() {
  TrackedObjects_ message;
  message.header().stamp().sec(1'700'000'000);
  message.header().stamp().nanosec(250'000'000);
  message.header().frame_id("map");
  message.objects({truck()});
  return message;
}

TrackedObject taken(const TrackedObject_& object) {
  TrackedObjects_ from = message();
  from.objects({object});
  TrackedObjects to;
  EXPECT_EQ(from_ros(from, "map", to), "");
  return to.objects.at(0);
}

TEST(RosObjects, HaveTheFieldsOfLaneloom) {
  TrackedObjects to;
  to.objects.resize(3);
  ASSERT_EQ(from_ros(message(), "map", to), "");
  EXPECT_EQ(to.stamp_ns, 1'700'000'000'250'000'000);
  EXPECT_EQ(to.session_id, 0U);
  EXPECT_TRUE(to.in_map_frame);
  ASSERT_EQ(to.objects.size(), 1U);
  const TrackedObject& object = to.objects[0];
  EXPECT_EQ(object.kind, ObjectKind::truck);
  EXPECT_EQ(object.existence_probability, 0.75);
  EXPECT_EQ(object.position, Point(20.0, 30.0, 2.0)) << "on the ground";
  EXPECT_TRUE(object.heading.isApprox(Point::UnitY(), 1e-9));
  EXPECT_EQ(object.speed_mps, 8.0);
  EXPECT_NEAR(object.position_stddev_m, 0.3, 1e-12);
  EXPECT_EQ(object.length_m, 9.0);
  EXPECT_EQ(object.width_m, 2.5);
}

TEST(RosObjects, KeepTheirIds) {
  auto other = truck();
  EXPECT_EQ(taken(truck()).id, taken(truck()).id);
  for (std::size_t i = 0; i < 16; ++i) {
    other = truck();
    other.object_id().uuid()[i] ^= 1U;
    EXPECT_NE(taken(other).id, taken(truck()).id) << i;
  }
}

TEST(RosObjects, OfAClassThatLaneloomDoesNotHaveAreUnknown) {
  auto object = truck();
  const auto kind = [&](std::vector<ObjectClassification_> classes) {
    object.classification(std::move(classes));
    return taken(object).kind;
  };
  EXPECT_EQ(kind({}), ObjectKind::unknown);
  EXPECT_EQ(kind({classified(7, 1.0F)}), ObjectKind::pedestrian);
  EXPECT_EQ(kind({classified(8, 1.0F)}), ObjectKind::unknown) << "an animal";
  EXPECT_EQ(kind({classified(255, 1.0F), classified(1, 0.5F)}), ObjectKind::unknown);
}

TEST(RosObjects, HaveNoHeadingThatIsNotAvailable) {
  auto object = truck();
  object.kinematics().orientation_availability(0);
  EXPECT_EQ(taken(object).heading, Point::Zero());
  EXPECT_EQ(taken(object).speed_mps, 8.0);
  object.kinematics().pose_with_covariance().pose().orientation().w(0.0);  // nobody has to fill it
  object.kinematics().pose_with_covariance().pose().orientation().z(0.0);
  EXPECT_EQ(taken(object).heading, Point::Zero());
}

TEST(RosObjects, WhoseHeadingHasNoKnownSignHeadWhereTheyMove) {
  auto object = truck();
  object.kinematics().orientation_availability(1);
  EXPECT_TRUE(taken(object).heading.isApprox(Point::UnitY(), 1e-9));
  EXPECT_EQ(taken(object).speed_mps, 8.0);
  auto& velocity = object.kinematics().twist_with_covariance().twist().linear();
  velocity.x(-8.0);
  EXPECT_TRUE(taken(object).heading.isApprox(-Point::UnitY(), 1e-9));
  EXPECT_EQ(taken(object).speed_mps, 8.0) << "forwards";
  for (const double speed_mps : {0.9, -0.9}) {
    velocity.x(speed_mps);
    EXPECT_EQ(taken(object).heading, Point::Zero()) << speed_mps;
    EXPECT_EQ(taken(object).speed_mps, speed_mps);
  }
  velocity.x(-8.0);
  object.kinematics().is_stationary(true);
  EXPECT_EQ(taken(object).heading, Point::Zero());
  object.kinematics().orientation_availability(2);
  object.kinematics().is_stationary(false);
  EXPECT_TRUE(taken(object).heading.isApprox(Point::UnitY(), 1e-9)) << "reverses";
  EXPECT_EQ(taken(object).speed_mps, -8.0);
}

TEST(RosObjects, ThatStandHaveNoSpeed) {
  auto object = truck();
  object.kinematics().is_stationary(true);
  EXPECT_EQ(taken(object).speed_mps, 0.0);
}

TEST(RosObjects, WhatIsNotKnownIsMinusOne) {
  auto object = truck();
  object.shape().dimensions().x(0.0);
  object.shape().dimensions().y(0.0);
  for (const double variance : {-1.0, std::nan(""), HUGE_VAL}) {
    object.kinematics().pose_with_covariance().covariance()[7] = variance;
    EXPECT_EQ(taken(object).position_stddev_m, -1.0) << variance;
  }
  EXPECT_EQ(taken(object).length_m, -1.0);
  EXPECT_EQ(taken(object).width_m, -1.0);
}

TEST(RosObjects, MayBeInTheFrameOfTheVehicle) {
  auto from = message();
  from.header().frame_id("base_link");
  TrackedObjects to{.in_map_frame = true};
  EXPECT_EQ(from_ros(from, "map", to), "");
  EXPECT_FALSE(to.in_map_frame);
}

TEST(RosObjects, AreRefusedForWhatIsWrong) {
  const auto refusal = [](auto change) {
    auto from = message();
    change(from, from.objects()[0]);
    TrackedObjects to;
    return from_ros(from, "map", to);
  };
  const double nan = std::nan("");
  EXPECT_EQ(refusal([](auto& m, auto&) { m.header().frame_id("odom"); }), "wrong_frame");
  EXPECT_EQ(refusal([](auto& m, auto&) { m.header().stamp().nanosec(1'000'000'000); }), "stamp");
  EXPECT_EQ(refusal([](auto&, auto& o) { o.kinematics().orientation_availability(3); }), "unknown_enum");
  EXPECT_EQ(refusal([&](auto&, auto& o) { o.shape().dimensions().z(nan); }), "not_finite");
  EXPECT_EQ(refusal([&](auto&, auto& o) { o.existence_probability(std::nanf("")); }), "not_finite");
  EXPECT_EQ(refusal([&](auto&, auto& o) { o.classification()[1].probability(std::nanf("")); }), "not_finite");
  EXPECT_EQ(refusal([&](auto&, auto& o) { o.kinematics().pose_with_covariance().pose().position().y(nan); }),
            "not_finite");
  EXPECT_EQ(refusal([&](auto&, auto& o) { o.kinematics().twist_with_covariance().twist().linear().x(nan); }),
            "not_finite");
  EXPECT_EQ(
      refusal([](auto&, auto& o) { o.kinematics().pose_with_covariance().pose().orientation().w(0.9); }),
      "not_a_rotation");
}

TEST(RosObjects, OfAnyBytesAreReadOrRefused) {
  auto from = message();
  from.objects()[0].shape().footprint().points().resize(3);
  const auto bytes = bytes_of(from);
  expect_only_whole<ObjectsType>(bytes);
  EXPECT_EQ(read<ObjectsType>(bytes).message.objects()[0].shape().dimensions().z(), 3.0);
}

TEST(RosObjects, BeyondABoundAreRefused) {
  auto from = message();
  const auto refusal = [&] { return read<ObjectsType>(bytes_of(from)).refusal; };
  from.objects().assign(256, truck());
  EXPECT_EQ(refusal(), "");
  from.objects().assign(257, truck());
  EXPECT_EQ(refusal(), "malformed");
  from.objects().assign(1, truck());
  from.objects()[0].shape().footprint().points().resize(1025);
  EXPECT_EQ(refusal(), "malformed");
  from.objects().assign(1, truck());
  from.objects()[0].classification().resize(65);
  EXPECT_EQ(refusal(), "malformed");
}

}  // namespace
}  // namespace laneloom::ros2
