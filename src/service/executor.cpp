#include "service/executor.hpp"

#include "core/phase_lock.hpp"

namespace laneloom::service {

void run_periodically(std::int64_t period_ns, const Timing& timing,
                      const std::function<void(const core::Tick&)>& task) {
  core::PhaseLock phase(period_ns, timing.now_ns());
  while (timing.sleep_until(phase.deadline_ns())) {
    for (const std::int64_t at_ns : timing.take_ready()) phase.note_ready(at_ns);
    const std::int64_t now_ns = timing.now_ns();
    if (now_ns < phase.deadline_ns()) continue;
    task(phase.begin(now_ns));
    phase.end(timing.now_ns());
  }
}

}  // namespace laneloom::service
