#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace laneloom::support {

/// How far some work is.
struct Progress {
  double share = 0.0;      ///< of the work that is done, 0..1
  std::size_t steps = 0;   ///< that are done
  double elapsed_s = 0.0;  ///< since the work began
};

/// One line: a bar, the share in percent, the steps a second, and the time left: "[##..]  50 %  400/s  0:12
/// left".
std::string text(const Progress& progress);

/// Shows on a terminal, and nowhere else, how far some work is. The bar is gone when the object is. Not
/// thread-safe.
class ProgressBar {
 public:
  ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() { clear(); }

  /// Tells that a step is done, and with it this share of the work. A share of 0 is not known, as of a pipe.
  void step(double share);
  /// Takes the bar away. The next step shows it again.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool is_terminal_;
  bool is_shown_ = false;
  std::size_t steps_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
};

}  // namespace laneloom::support
