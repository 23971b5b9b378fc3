#pragma once

#include <cstdint>

namespace laneloom::core {

/// One run of a periodic task, by the steady clock.
struct Tick {
  std::int64_t deadline_ns = 0;  ///< the time at which it was to start
  std::int64_t start_ns = 0;     ///< the time at which it did start
  std::uint64_t missed = 0;      ///< number of deadlines without a tick since the tick before
};

}  // namespace laneloom::core
