#include "core/phase_lock.hpp"

#include <algorithm>

namespace laneloom::core {
namespace {

constexpr int kEmptyToForget = 10;     // periods without a frame, after which none is waited for
constexpr int kPatience_percent = 30;  // of a period
constexpr int kGainShare = 2;          // a phase error is halved in each period

}  // namespace

bool PhaseLock::is_locked() const { return empty_ && *empty_ < kEmptyToForget; }

int PhaseLock::wanted() const { return std::max(1, std::min(frames_before_, frames_long_before_)); }

std::int64_t PhaseLock::patience_ns() const { return is_locked() ? period_ns_ / 100 * kPatience_percent : 0; }

void PhaseLock::note_ready(std::int64_t at_ns) {
  if (!is_locked()) return lock_onto(at_ns);
  const std::int64_t late_ns = at_ns - expected_ns_;
  empty_ = 0;
  if (late_ns < -period_ns_ / 2) {  // of the period before, whose tick came without it
    ++frames_before_;
    errors_.add(std::max(late_ns + period_ns_, -period_ns_ / 2));
    return;
  }
  if (++frames_ >= wanted() && !complete_ns_) complete_ns_ = at_ns;
  errors_.add(std::min(late_ns, period_ns_ / 2));
}

void PhaseLock::lock_onto(std::int64_t at_ns) {
  empty_ = 0;
  frames_ = frames_before_ = frames_long_before_ = 0;
  errors_ = {};
  complete_ns_.reset();
  expected_ns_ = at_ns + period_ns_;
  if (start_ns_ && at_ns < *start_ns_ + period_ns_ / 2) return;  // too near: the next one is waited for
  expected_ns_ = at_ns;
  complete_ns_ = at_ns;
  frames_ = 1;
}

std::int64_t PhaseLock::deadline_ns() const {
  const std::int64_t due_ns = complete_ns_.value_or(expected_ns_ + patience_ns());
  return start_ns_ ? std::max(due_ns, *start_ns_ + period_ns_ / 2) : due_ns;
}

Tick PhaseLock::begin(std::int64_t now_ns) {
  const std::int64_t deadline_ns = this->deadline_ns();
  const std::int64_t slept = std::max<std::int64_t>(0, (now_ns - deadline_ns) / period_ns_);
  expected_ns_ += slept * period_ns_;
  const Tick tick{deadline_ns, now_ns, missed_ + static_cast<std::uint64_t>(slept)};
  start_ns_ = now_ns;
  return tick;
}

void PhaseLock::end(std::int64_t now_ns) {
  if (empty_) empty_ = frames_ > 0 ? 0 : std::min(*empty_ + 1, kEmptyToForget);
  frames_long_before_ = frames_before_;
  frames_before_ = frames_;
  frames_ = 0;
  complete_ns_.reset();
  expected_ns_ += period_ns_ + errors_.mean_ns() / kGainShare;
  errors_ = {};
  missed_ = 0;
  for (; now_ns > expected_ns_ + patience_ns(); expected_ns_ += period_ns_) ++missed_;
}

}  // namespace laneloom::core
