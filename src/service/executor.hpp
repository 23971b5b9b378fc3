#pragma once

#include <cstdint>
#include <functional>

#include "core/tick.hpp"

namespace laneloom {

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
