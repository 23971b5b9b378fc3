#pragma once

#include <cstdint>
#include <functional>

namespace laneloom {

/// One run of a periodic task.
struct Tick {
  std::int64_t deadline_ns = 0;  ///< when it was to start
  std::int64_t start_ns = 0;     ///< when it did
  std::uint64_t missed = 0;      ///< deadlines between it and the tick before, which passed without a tick
};

/// The clock of an executor; steady.
struct Timing {
  std::function<std::int64_t()> now_ns;
  /// Returns at the deadline, or with false when the executor is to stop.
  std::function<bool(std::int64_t deadline_ns)> sleep_until;
};

/// Calls `task` at absolute deadlines, `period_ns` apart, until sleep_until() returns false. A slow task
/// never shifts the deadlines: those that pass meanwhile are missed, and counted.
void run_periodically(std::int64_t period_ns, const Timing& timing,
                      const std::function<void(const Tick&)>& task);

}  // namespace laneloom
