#include "commands/stop_signal.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <thread>

namespace laneloom::commands {
namespace {

constexpr std::chrono::milliseconds kReaction{50};

// Global, because a signal handler can reach nothing else.
std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void request_stop(int) { stop = true; }

}  // namespace

void catch_stop_signals() {
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
}

bool stop_requested() { return stop; }

bool sleep_until(std::chrono::steady_clock::time_point deadline) {
  for (auto now = std::chrono::steady_clock::now(); now < deadline && !stop_requested();
       now = std::chrono::steady_clock::now())
    std::this_thread::sleep_until(std::min(deadline, now + kReaction));
  return !stop_requested();
}

}  // namespace laneloom::commands
