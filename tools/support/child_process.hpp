#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <vector>

namespace laneloom::support {

/// A program that runs beside this one. It is ended at the latest when this process ends.
class ChildProcess {
 public:
  /// Starts a program, whose output goes to the open file `output`. Throws std::runtime_error if it cannot be
  /// started.
  explicit ChildProcess(std::vector<std::string> command, int output = STDERR_FILENO);
  /// The same, with the output to the file at the path `output`.
  ChildProcess(std::vector<std::string> command, const std::string& output);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t id() const { return id_; }
  void signal(int number) const;
  bool running();
  /// Waits until it has ended. Returns its exit code, or minus the signal that ended it.
  int wait();
  /// Asks the program to end (SIGTERM), and kills it if it has not ended after `patience`. Returns the
  /// problem with its end; empty: it ended when asked, with exit code 0.
  std::string stop(std::chrono::milliseconds patience = std::chrono::seconds(10));
  /// The problem with its end, once it is not running. Empty: it ended with exit code 0.
  std::string failure() const;

 private:
  pid_t id_ = -1;  ///< -1: it has ended
  int status_ = 0;
};

}  // namespace laneloom::support
