#pragma once

#include <cstdint>
#include <random>

namespace laneloom {

/// A random id for a session or a map: a different one every time, never 0.
inline std::uint64_t random_id() {
  std::random_device device;
  return (std::uint64_t{device()} << 32U | device()) | 1U;
}

}  // namespace laneloom
