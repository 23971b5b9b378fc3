#include "ros2/tracked_objects.hpp"

#include <cstddef>
#include <cstdint>

#include "ros2/input.hpp"
#include "ros2/read.hpp"

/// A reader of Autoware's tracked objects takes or refuses any payload.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto sample = laneloom::read<laneloom::ros2::ObjectsType>({data, data + size});
  laneloom::TrackedObjects objects;
  if (sample.refusal.empty()) laneloom::ros2::from_ros(sample.message, "map", objects);
  return 0;
}
