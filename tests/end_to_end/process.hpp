#pragma once

#include <optional>
#include <string>
#include <vector>

#include "support/child_process.hpp"
#include "temporary_folder.hpp"

namespace laneloom {

/// A program in a process of its own, whose output is kept; killed at the latest when this ends.
class Process {
 public:
  /// Throws std::runtime_error when it can't be started.
  explicit Process(const std::vector<std::string>& command) : child_(command, folder_.file("output")) {}

  pid_t id() const { return child_.id(); }
  void signal(int number) const { child_.signal(number); }
  /// Its exit code, or minus the number of the signal that ended it. None: it still runs after a minute.
  std::optional<int> wait();
  /// Its errors and other output so far.
  std::string errors() const { return content(folder_.file("output")); }
  /// Waits (for half a minute at most) until it wrote `text`.
  bool wait_for_error(const std::string& text) const;

 private:
  TemporaryFolder folder_;
  support::ChildProcess child_;
};

}  // namespace laneloom
