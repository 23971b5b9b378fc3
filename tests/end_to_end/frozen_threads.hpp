#pragma once

#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace laneloom {

/// Stops those threads of a process that wait for datagrams, as a debugger does. They stay so until it ends.
class FrozenThreads {
 public:
  explicit FrozenThreads(pid_t process) {
    const std::filesystem::path tasks = "/proc/" + std::to_string(process) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks)) {
      const auto thread = static_cast<pid_t>(std::stol(task.path().filename()));
      if (thread == process || !receives(task.path())) continue;
      if (ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) != 0) continue;
      ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr);
      threads_.push_back(thread);
    }
  }
  ~FrozenThreads() {
    for (const pid_t thread : threads_) ptrace(PTRACE_DETACH, thread, nullptr, nullptr);
  }
  FrozenThreads(const FrozenThreads&) = delete;
  FrozenThreads& operator=(const FrozenThreads&) = delete;

  /// None: this user may not.
  std::size_t count() const { return threads_.size(); }
  /// Waits until the process has ended: a thread that is stopped does not end by itself.
  void wait_for_end() {
    for (const pid_t thread : threads_) {
      int status = 0;
      while (waitpid(thread, &status, __WALL) == thread && WIFSTOPPED(status)) continue;
    }
    threads_.clear();
  }

 private:
  static bool receives(const std::filesystem::path& task) {
    constexpr int kReceiveFrom = 45, kReceiveMessage = 47;  // calls of the kernel, on x86-64
    int call = -1;
    std::ifstream(task / "syscall") >> call;
    return call == kReceiveFrom || call == kReceiveMessage;
  }

  std::vector<pid_t> threads_;
};

}  // namespace laneloom
