#pragma once

#include <cstdint>
#include <vector>

#include "cdr/serialise.hpp"

namespace laneloom {

/// A message of ROS as it goes over the wire.
template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  std::vector<std::uint8_t> bytes;
  dds::write_cdr(message, bytes);
  return bytes;
}

}  // namespace laneloom
