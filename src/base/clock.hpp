#pragma once

#include <chrono>
#include <cstdint>

namespace laneloom {

/// Nanoseconds of a clock of the standard library.
template <class Clock>
std::int64_t nanoseconds_of() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

inline std::int64_t steady_now_ns() { return nanoseconds_of<std::chrono::steady_clock>(); }

/// The processes of a host share this clock.
inline std::int64_t system_now_ns() { return nanoseconds_of<std::chrono::system_clock>(); }

}  // namespace laneloom
