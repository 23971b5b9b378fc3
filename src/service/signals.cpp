#include "service/signals.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace laneloom::service {
namespace {

// Less than the unit's TimeoutStopSec. An end in good order takes some tenths of a second.
constexpr std::chrono::milliseconds kPatience{2500};

sigset_t our_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  return signals;
}

}  // namespace

Signals::Signals() {
  const sigset_t signals = our_signals();
  const int error = pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  if (error != 0) throw std::system_error(error, std::generic_category(), "pthread_sigmask");
  thread_ = std::jthread([this](const std::stop_token& ended) { run(ended); });
}

Signals::~Signals() {
  thread_.request_stop();
  pthread_kill(thread_.native_handle(), SIGHUP);  // in case that it waits for a signal
}

void Signals::run(const std::stop_token& ended) {
  const sigset_t signals = our_signals();
  while (!ended.stop_requested()) {
    const int signal = sigwaitinfo(&signals, nullptr);
    if (signal < 0 || ended.stop_requested()) continue;
    tell(signal == SIGHUP ? Wake::reload : Wake::stop);
    if (signal == SIGHUP) continue;
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, ended, kPatience, [] { return false; }) || ended.stop_requested()) return;
    spdlog::critical("event=end_forced why=\"it hangs\"");
    std::_Exit(EXIT_FAILURE);
  }
}

void Signals::tell(Wake wake) {
  const std::lock_guard lock(mutex_);
  told_ = std::max(told_, wake);
  changed_.notify_all();
}

Wake Signals::sleep_until(std::int64_t deadline_ns) {
  const std::chrono::steady_clock::time_point deadline{std::chrono::nanoseconds(deadline_ns)};
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [this] { return told_ != Wake::deadline; });
  return std::exchange(told_, Wake::deadline);
}

}  // namespace laneloom::service
