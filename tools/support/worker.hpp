#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace laneloom::support {

/// Does jobs on a thread of its own, one after the other, in the order in which they are given. One thread
/// gives them.
class Worker {
 public:
  /// Number of jobs, with the one at hand, beyond which add() waits. With a map each, they take less than a
  /// megabyte.
  static constexpr std::size_t kMostJobs = 16;

  Worker();
  /// Waits for the job at hand. Jobs that wait are dropped.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Hands over a job, and waits while many others wait. Throws what an earlier job has thrown, behind which
  /// no job is done.
  void add(std::function<void()> job);
  /// Waits until all jobs are done. Throws what one of them has thrown.
  void finish();

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;  ///< the first one is at hand, if the thread works
  bool ends_ = false;
  std::exception_ptr failure_;
  std::jthread thread_;  ///< the last member: it ends before the others
};

}  // namespace laneloom::support
