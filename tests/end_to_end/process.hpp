#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace laneloom {

/// A program in a process of its own; killed at the latest when this ends.
class Process {
 public:
  /// Throws std::runtime_error when it can't be started.
  explicit Process(const std::vector<std::string>& command);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t id() const { return pid_; }
  void signal(int number) const;
  /// Its exit code, or minus the number of the signal that ended it. None: it still runs after a minute.
  std::optional<int> wait();
  /// What it wrote on standard error so far.
  std::string errors() const;
  /// Waits (for half a minute at most) until it wrote `text` there.
  bool wait_for_error(const std::string& text) const;

 private:
  pid_t pid_ = -1;
  std::string error_file_;
};

}  // namespace laneloom
