#include "support/stage_timer.hpp"

#include <utility>

#include "base/distribution.hpp"

namespace laneloom::support {
namespace {

double milliseconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace

TimeSummary summarise(std::vector<double> values_ms) {
  const Distribution times_ms(std::move(values_ms));
  return {times_ms.mean(), times_ms.quantile(0.5), times_ms.quantile(0.99), times_ms.quantile(1.0)};
}

void StageTimer::update_begins() {
  for (std::vector<double>& stage_ms : stages_ms_) stage_ms.push_back(0.0);
  total_ms_.push_back(0.0);
  stage_start_ = Clock::now();
}

void StageTimer::stage_done(Stage stage) {
  const Clock::time_point now = Clock::now();
  const auto i = static_cast<std::size_t>(stage);
  stages_ms_.at(i).back() += milliseconds(now - stage_start_);
  total_ms_.back() += milliseconds(now - stage_start_);
  reached_.at(i) = true;
  stage_start_ = now;
}

TimeSummary StageTimer::stage(Stage stage) const {
  return summarise(stages_ms_.at(static_cast<std::size_t>(stage)));
}

TimeSummary StageTimer::total() const { return summarise(total_ms_); }

bool StageTimer::reached(Stage stage) const { return reached_.at(static_cast<std::size_t>(stage)); }

}  // namespace laneloom::support
