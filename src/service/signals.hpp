#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace laneloom::service {

/// The event that ended a sleep; the more urgent, the later.
enum class Wake { deadline, call, reload, stop };

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

  /// Sleeps until a deadline of the steady clock, or until a signal or a call comes. One thread calls it.
  Wake sleep_until(std::int64_t deadline_ns);
  /// Ends the present sleep, or else the next one. Any thread may call it.
  void call() { tell(Wake::call); }

 private:
  void run(const std::stop_token& ended);
  void tell(Wake wake);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  Wake told_ = Wake::deadline;  ///< the most urgent event since the last sleep; deadline: none
  std::jthread thread_;
};

}  // namespace laneloom::service
