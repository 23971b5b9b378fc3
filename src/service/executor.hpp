#pragma once

#include <cstdint>
#include <functional>

#include "core/tick.hpp"

namespace laneloom::service {

/// The steady clock of an executor.
struct Timing {
  std::function<std::int64_t()> now_ns;
  /// Returns true at the deadline, or false when the executor is to stop.
  std::function<bool(std::int64_t deadline_ns)> sleep_until;
};

/// Calls `task` at absolute deadlines, `period_ns` apart, until sleep_until() returns false. A slow task
/// never shifts the deadlines: deadlines that pass meanwhile are missed, and counted.
void run_periodically(std::int64_t period_ns, const Timing& timing,
                      const std::function<void(const core::Tick&)>& task);

}  // namespace laneloom::service
