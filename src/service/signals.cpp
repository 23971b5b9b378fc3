#include "service/signals.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>

namespace laneloom::service {

Signals::Signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  const int error = pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  if (error != 0) throw std::system_error(error, std::generic_category(), "pthread_sigmask");
  file_ = signalfd(-1, &signals, SFD_CLOEXEC);
  if (file_ < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
}

Signals::~Signals() { close(file_); }

Wake Signals::sleep_until(std::int64_t deadline_ns) const {
  while (true) {
    const auto left_ns = std::max<std::int64_t>(0, deadline_ns - steady_now_ns());
    const timespec timeout{left_ns / 1'000'000'000, left_ns % 1'000'000'000};
    pollfd event{file_, POLLIN, 0};
    const int ready = ppoll(&event, 1, &timeout, nullptr);
    if (ready > 0) {
      signalfd_siginfo info{};
      if (read(file_, &info, sizeof info) != static_cast<ssize_t>(sizeof info)) continue;
      return info.ssi_signo == static_cast<std::uint32_t>(SIGHUP) ? Wake::reload : Wake::stop;
    }
    if (ready == 0 && steady_now_ns() >= deadline_ns) return Wake::deadline;
  }
}

std::int64_t steady_now_ns() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace laneloom::service
