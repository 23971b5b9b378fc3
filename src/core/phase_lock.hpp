#pragma once

#include <cstdint>
#include <optional>

#include "core/tick.hpp"

namespace laneloom::core {

/// Decides when the ticks of a periodic task are due: as soon as the frames of a period are ready, or at the
/// end of the period if none are. The phase of the ticks is locked onto the frames as in a phase-locked loop;
/// their period stays that of the task, unless the frames' own period differs from it by less than a tenth.
/// No tick is due nearer than half a period to the start of the one before.
///
/// Times are nanoseconds of one steady clock, which the caller reads. Not thread-safe.
class PhaseLock {
 public:
  /// The first tick is due at `now_ns`.
  PhaseLock(std::int64_t period_ns, std::int64_t now_ns) : period_ns_(period_ns), expected_ns_(now_ns) {}

  /// Notes that a frame and the poses around its stamp were there at `at_ns`.
  void note_ready(std::int64_t at_ns);
  /// The time at which the next tick is due, by what was noted so far.
  std::int64_t deadline_ns() const;
  /// Begins the tick that is due.
  Tick begin(std::int64_t now_ns);
  /// Ends it. Deadlines that passed meanwhile are missed.
  void end(std::int64_t now_ns);

 private:
  /// The mean of how late frames are.
  struct Errors {
    std::int64_t sum_ns = 0, count = 0;

    void add(std::int64_t late_ns) {
      sum_ns += late_ns;
      ++count;
    }
    std::int64_t mean_ns() const { return count > 0 ? sum_ns / count : 0; }
  };

  bool is_locked() const;
  /// The number of frames that make a period complete: as many as each of the two periods before had.
  int wanted() const;
  /// The longest wait for frames that are late.
  std::int64_t patience_ns() const;
  void lock_onto(std::int64_t at_ns);

  std::int64_t period_ns_;
  std::int64_t expected_ns_;  ///< the time at which the frames of the present period are expected
  std::optional<std::int64_t> complete_ns_;  ///< the time at which they were ready; none: not yet
  std::optional<std::int64_t> start_ns_;     ///< of the newest tick; none: there was none
  int frames_ = 0, frames_before_ = 0, frames_long_before_ = 0;  ///< of this period and the two before
  Errors errors_;                                                ///< of the frames since the newest tick
  std::optional<int> empty_;  ///< periods since the newest frame; none: there was no frame
  std::uint64_t missed_ = 0;  ///< deadlines missed since the newest tick
};

}  // namespace laneloom::core
