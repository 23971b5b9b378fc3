#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

namespace laneloom::recording {

/// Gives the log times of a recording: the system's time at its start, and the steady time since. They rise
/// evenly, whatever becomes of the system clock, and no two are equal. Not thread-safe.
class LogClock {
 public:
  /// Reads a clock, in nanoseconds.
  using Clock = std::function<std::int64_t()>;

  LogClock(const Clock& system, Clock steady) : steady_(std::move(steady)), ahead_ns_(system() - steady_()) {}

  std::int64_t next() {
    newest_ns_ = std::max(newest_ns_ + 1, steady_() + ahead_ns_);
    return newest_ns_;
  }

 private:
  Clock steady_;
  std::int64_t ahead_ns_;  ///< of the system clock, at the start
  std::int64_t newest_ns_ = 0;
};

}  // namespace laneloom::recording
