#pragma once

#include <sys/types.h>

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
  /// Asks it to end (SIGTERM), and waits until it has.
  void stop();

 private:
  pid_t id_ = -1;
};

}  // namespace laneloom
