#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/tick.hpp"

namespace laneloom::service {

/// The steady clock of an executor, and what it wakes for.
struct Timing {
  std::function<std::int64_t()> now_ns;
  /// Returns true at the deadline or when a frame is ready, or false when the executor is to stop.
  std::function<bool(std::int64_t deadline_ns)> sleep_until;
  /// The times at which frames became ready since the last call, ascending.
  std::function<std::vector<std::int64_t>()> take_ready;
};

/// Calls `task` once in a period, in phase with the frames (core::PhaseLock), until sleep_until() returns
/// false. A slow task never shifts the deadlines: deadlines that pass meanwhile are missed, and counted.
void run_periodically(std::int64_t period_ns, const Timing& timing,
                      const std::function<void(const core::Tick&)>& task);

}  // namespace laneloom::service
