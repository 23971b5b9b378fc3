#pragma once

#include <cstdint>

namespace laneloom {

/// One run of a periodic task, by the steady clock.
struct Tick {
  std::int64_t deadline_ns = 0;  ///< when it was to start
  std::int64_t start_ns = 0;     ///< when it did
  std::uint64_t missed = 0;      ///< deadlines between it and the tick before, which passed without a tick
};

}  // namespace laneloom
