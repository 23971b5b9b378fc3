#include "service/time_window.hpp"

#include "base/distribution.hpp"

namespace laneloom::service {

void TimeWindow::add(double value_ms) {
  if (values_ms_.size() < capacity_) {
    values_ms_.push_back(value_ms);
  } else {
    values_ms_[next_] = value_ms;
  }
  next_ = (next_ + 1) % capacity_;
}

TimeSummary TimeWindow::summary() const {
  const Distribution times_ms(values_ms_);
  return {times_ms.mean(), times_ms.quantile(0.5), times_ms.quantile(0.99), times_ms.quantile(1.0)};
}

}  // namespace laneloom::service
