#include "service/executor.hpp"

#include <algorithm>

namespace laneloom::service {

void run_periodically(std::int64_t period_ns, const Timing& timing,
                      const std::function<void(const core::Tick&)>& task) {
  core::Tick tick;
  tick.deadline_ns = timing.now_ns();
  while (timing.sleep_until(tick.deadline_ns)) {
    tick.start_ns = timing.now_ns();
    task(tick);
    const auto late_ns = timing.now_ns() - tick.deadline_ns;
    const auto periods = std::max<std::int64_t>(1, (late_ns + period_ns - 1) / period_ns);
    tick.missed = static_cast<std::uint64_t>(periods - 1);
    tick.deadline_ns += periods * period_ns;
  }
}

}  // namespace laneloom::service
