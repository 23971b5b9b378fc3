#include "ros2/odometry.hpp"

#include <cstddef>
#include <cstdint>

#include "ros2/input.hpp"
#include "ros2/read.hpp"

/// A reader of odometry takes or refuses any payload.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto sample = laneloom::read<laneloom::ros2::OdometryType>({data, data + size});
  laneloom::VehiclePose pose;
  if (sample.refusal.empty()) laneloom::ros2::from_ros(sample.message, "map", pose);
  return 0;
}
