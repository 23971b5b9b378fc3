#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "dds/captured_datagrams.hpp"
#include "read.hpp"
#include "ros2/input.hpp"
#include "ros2/odometry.hpp"
#include "ros2/tracked_objects.hpp"

// What nodes of ROS 2 Jazzy sent, on rcl 9.2.0 and rmw_cyclonedds_cpp: one drove, the other one read the map.
namespace laneloom::ros2 {
namespace {

/// The samples in a datagram, as they were serialised.
void append_samples(const dds::Packet& datagram, std::vector<std::vector<std::uint8_t>>& samples) {
  constexpr std::size_t kHeaderBytes = 20, kSampleAt = 24;
  constexpr std::uint8_t kData = 0x15, kHasParameters = 0x02;
  for (std::size_t at = kHeaderBytes; at + kSampleAt < datagram.size();) {
    std::size_t end = at + 4 + datagram[at + 2] + 256U * datagram[at + 3];
    if (end == at + 4) end = datagram.size();  // the last submessage need not say how long it is
    if (datagram[at] == kData && (datagram[at + 1] & kHasParameters) == 0)
      samples.emplace_back(datagram.data() + at + kSampleAt, datagram.data() + end);
    at = end;
  }
}

/// The messages of a type among all samples of the nodes.
template <class Type>
auto messages() {
  std::vector<std::vector<std::uint8_t>> samples;
  for (const auto& datagram : dds::captured_datagrams(LANELOOM_CAPTURES "/ros_nodes.pcap"))
    append_samples(datagram, samples);
  std::vector<decltype(Type::Sample::message)> result;
  for (const auto& bytes : samples)
    if (auto sample = read<Type>(bytes); sample.refusal.empty()) result.push_back(sample.message);
  return result;
}

TEST(RealNodes, GiveTheirOdometry) {
  const auto odometry = messages<OdometryType>();
  ASSERT_FALSE(odometry.empty());
  VehiclePose pose;
  EXPECT_EQ(from_ros(odometry.front(), "map", pose), "");
  EXPECT_GT(pose.stamp_ns, 1'700'000'000'000'000'000);
  EXPECT_NEAR(pose.position.x(), -43.75, 0.1);
}

TEST(RealNodes, GiveTheirTrackedObjects) {
  const auto objects = messages<ObjectsType>();
  ASSERT_FALSE(objects.empty());
  TrackedObjects taken;
  EXPECT_EQ(from_ros(objects.front(), "map", taken), "");
  ASSERT_FALSE(taken.objects.empty());
  EXPECT_NEAR(taken.objects.front().length_m, 4.5, 1e-6);
}

}  // namespace
}  // namespace laneloom::ros2
