#include "ros2/odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bytes.hpp"
#include "read.hpp"
#include "ros2/input.hpp"

namespace laneloom::ros2 {
namespace {

using nav_msgs::msg::dds_::Odometry_;

Odometry_ odometry() {
  Odometry_ message;
  message.header().stamp().sec(1'700'000'000);
  message.header().stamp().nanosec(250'000'000);
  message.header().frame_id("map");
  message.child_frame_id("base_link");
  message.pose().pose().position().x(1.0);
  message.pose().pose().position().y(2.0);
  message.pose().pose().position().z(3.0);
  message.pose().pose().orientation().z(std::sqrt(0.5));
  message.pose().pose().orientation().w(std::sqrt(0.5));
  return message;
}

TEST(Odometry, IsAPose) {
  VehiclePose pose;
  EXPECT_EQ(from_ros(odometry(), "map", pose), "");
  EXPECT_EQ(pose.stamp_ns, 1'700'000'000'250'000'000);
  EXPECT_EQ(pose.session_id, 0U);
  EXPECT_EQ(pose.position, Point(1.0, 2.0, 3.0));
  EXPECT_TRUE((pose.orientation * Point::UnitX()).isApprox(Point::UnitY(), 1e-9));
}

TEST(Odometry, IsRefusedForWhatIsWrong) {
  const auto refusal = [](auto change) {
    auto message = odometry();
    change(message);
    VehiclePose pose;
    return from_ros(message, "map", pose);
  };
  EXPECT_EQ(refusal([](auto& m) { m.header().frame_id("odom"); }), "wrong_frame");
  EXPECT_EQ(refusal([](auto& m) { m.header().stamp().nanosec(1'000'000'000); }), "stamp");
  EXPECT_EQ(refusal([](auto& m) { m.pose().pose().orientation().w(0.9); }), "not_a_rotation");
  EXPECT_EQ(refusal([](auto& m) { m.pose().pose().position().y(std::nan("")); }), "not_finite");
  // Many give what they do not know as NaN or -1.
  EXPECT_EQ(refusal([](auto& m) { m.pose().covariance()[0] = std::nan(""); }), "");
}

TEST(Odometry, OfAnyBytesIsReadOrRefused) {
  const auto bytes = bytes_of(odometry());
  expect_only_whole<OdometryType>(bytes);
  EXPECT_EQ(read<OdometryType>(bytes).message.child_frame_id(), "base_link");
  auto huge = bytes;
  for (const std::size_t i : {12U, 13U, 14U, 15U}) huge.at(i) = 0xFF;  // the length of frame_id
  EXPECT_EQ(read<OdometryType>(huge).refusal, "malformed");
}

}  // namespace
}  // namespace laneloom::ros2
