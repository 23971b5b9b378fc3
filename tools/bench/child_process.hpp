#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace laneloom {

/// A program that runs beside this one; ended at the latest with it.
class ChildProcess {
 public:
  /// All that it prints goes to the file `output`. Throws std::runtime_error where it cannot be started.
  ChildProcess(std::vector<std::string> command, const std::string& output);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t id() const { return id_; }
  bool running();
  /// Asks it to end (SIGTERM), and kills it when it has not after `patience`. Returns what was wrong with its
  /// end; empty where it ended then, with exit code 0.
  std::string stop(std::chrono::milliseconds patience = std::chrono::seconds(10));
  /// How it ended, once it is not running; empty: with exit code 0.
  std::string failure() const;

 private:
  pid_t id_ = -1;  ///< -1: it has ended
  int status_ = 0;
};

}  // namespace laneloom
