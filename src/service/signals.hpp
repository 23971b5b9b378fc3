#pragma once

#include <cstdint>

namespace laneloom::service {

/// The event that ended a sleep.
enum class Wake { deadline, stop, reload };

/// Takes SIGTERM, SIGINT and SIGHUP as file events, so that no work is done in a signal handler. It must be
/// made before any thread is started: it blocks these signals, and threads inherit that.
class Signals {
 public:
  /// Throws std::system_error.
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// Sleeps until a deadline of the steady clock, or until a signal comes.
  Wake sleep_until(std::int64_t deadline_ns) const;

 private:
  int file_ = -1;
};

/// Nanoseconds of the steady clock.
std::int64_t steady_now_ns();

}  // namespace laneloom::service
