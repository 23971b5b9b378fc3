#include "support/progress_bar.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace laneloom::support {
namespace {

constexpr int kWidth = 40;
constexpr std::chrono::milliseconds kPeriod{100};
constexpr double kLongest_s = 100.0 * 3600.0;

}  // namespace

std::string text(const Progress& progress) {
  const double rate_hz =
      progress.elapsed_s > 0.0 ? static_cast<double>(progress.steps) / progress.elapsed_s : 0.0;
  const std::string rate = fmt::format("{:.0f}/s", rate_hz);
  if (!(progress.share > 0.0)) return fmt::format("{} done, {}", progress.steps, rate);
  const double share = std::min(progress.share, 1.0);
  const int done = static_cast<int>(share * kWidth);
  const double left_s = std::min(progress.elapsed_s * (1.0 / share - 1.0), kLongest_s);
  const int left = static_cast<int>(std::ceil(left_s));
  return fmt::format("[{:#<{}}{:.<{}}] {:3.0f} %  {}  {}:{:02} left", "", done, "", kWidth - done,
                     100.0 * share, rate, left / 60, left % 60);
}

ProgressBar::ProgressBar() : is_terminal_(isatty(STDERR_FILENO) == 1) {}

void ProgressBar::step(double share) {
  ++steps_;
  const auto now = Clock::now();
  if (!is_terminal_ || now < next_) return;
  next_ = now + kPeriod;
  is_shown_ = true;
  const std::chrono::duration<double> elapsed = now - start_;
  fmt::print(stderr, "\r{}\033[K", text({share, steps_, elapsed.count()}));
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (is_shown_) fmt::print(stderr, "\r\033[K");
  is_shown_ = false;
}

}  // namespace laneloom::support
