#include <cstddef>
#include <cstdint>
#include <vector>

#include "ros2/input.hpp"
#include "ros2/odometry.hpp"

/// A reader of odometry takes or refuses any payload.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using laneloom::ros2::OdometryType;
  std::vector<std::uint8_t> bytes(data, data + size);
  OdometryType type;
  OdometryType::Sample sample;
  OdometryType::Payload payload;
  payload.data = bytes.data();
  payload.length = payload.max_size = static_cast<std::uint32_t>(bytes.size());
  type.deserialize(&payload, &sample);
  payload.data = nullptr;  // it is none of the payload's to free
  laneloom::VehiclePose pose;
  if (sample.refusal.empty()) laneloom::ros2::from_ros(sample.message, "map", pose);
  return 0;
}
