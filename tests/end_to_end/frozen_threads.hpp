#pragma once

#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace laneloom {

/// Stops those threads of a process that wait for datagrams, as a debugger does. They stay so until it ends.
class FrozenThreads {
 public:
  explicit FrozenThreads(pid_t process) : process_(process) { freeze(); }
  ~FrozenThreads() {
    for (const pid_t thread : threads_) ptrace(PTRACE_DETACH, thread, nullptr, nullptr);
  }
  FrozenThreads(const FrozenThreads&) = delete;
  FrozenThreads& operator=(const FrozenThreads&) = delete;

  /// None: this user may not.
  std::size_t count() const { return threads_.size(); }
  /// Waits until the process has ended: a thread that is stopped does not end by itself. Threads that were
  /// busy with a datagram are stopped when they wait for the next one.
  void wait_for_end() {
    while (!threads_.empty()) {
      freeze();
      std::erase_if(threads_, [](pid_t thread) {
        int status = 0;
        const pid_t changed = waitpid(thread, &status, __WALL | WNOHANG);
        return changed < 0 || (changed == thread && !WIFSTOPPED(status));
      });
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

 private:
  void freeze() {
    std::error_code gone;
    const std::filesystem::path tasks = "/proc/" + std::to_string(process_) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks, gone)) {
      const auto thread = static_cast<pid_t>(std::stol(task.path().filename()));
      if (thread == process_ || std::ranges::count(threads_, thread) > 0 || !receives(task.path())) continue;
      if (ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) != 0) continue;
      ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr);
      threads_.push_back(thread);
    }
  }
  static bool receives(const std::filesystem::path& task) {
    long call = -1;
    std::ifstream(task / "syscall") >> call;
    return call == SYS_recvfrom || call == SYS_recvmsg;
  }

  pid_t process_;
  std::vector<pid_t> threads_;
};

}  // namespace laneloom
