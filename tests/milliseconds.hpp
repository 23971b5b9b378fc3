#pragma once

#include <cstdint>

namespace laneloom {

inline constexpr std::int64_t kMs = 1'000'000;  ///< in nanoseconds

}  // namespace laneloom
