#pragma once

#include <cstdint>

namespace laneloom {

/// A duration, or a stamp, in seconds. Beyond 104 days a double no longer tells single nanoseconds apart.
constexpr double seconds(std::int64_t duration_ns) { return static_cast<double>(duration_ns) / 1e9; }
/// A duration in whole nanoseconds; what is left of one is cut off.
constexpr std::int64_t nanoseconds(double duration_s) { return static_cast<std::int64_t>(duration_s * 1e9); }

/// Stamps are less: their differences do not overflow.
inline constexpr std::int64_t kMaxStamp_ns = std::int64_t{1} << 62;

}  // namespace laneloom
