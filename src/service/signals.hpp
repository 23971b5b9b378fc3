#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace laneloom::service {

/// The event that ended a sleep.
enum class Wake { deadline, stop, reload };

/// Takes SIGTERM, SIGINT and SIGHUP in a thread of its own, so that no work is done in a signal handler. It
/// must be made before any other thread is started: it blocks these signals, and threads inherit that.
///
/// A process that is told to end, and still has this object after some seconds, is ended by it, with exit
/// code 1: a thread may hang in DDS.
class Signals {
 public:
  /// Throws std::system_error.
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// Sleeps until a deadline of the steady clock, or until a signal comes. One thread calls it.
  Wake sleep_until(std::int64_t deadline_ns);

 private:
  void run(const std::stop_token& ended);
  void tell(Wake wake);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  Wake told_ = Wake::deadline;  ///< the signal that came last; deadline: none
  std::jthread thread_;
};

/// Nanoseconds of the steady clock.
std::int64_t steady_now_ns();

}  // namespace laneloom::service
