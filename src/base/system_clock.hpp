#pragma once

#include <chrono>
#include <cstdint>

namespace laneloom {

/// Nanoseconds of the system clock, which the processes of a host share.
inline std::int64_t system_now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace laneloom
