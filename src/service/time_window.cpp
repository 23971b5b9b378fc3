#include "service/time_window.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace laneloom {

void TimeWindow::add(double value_ms) {
  if (values_ms_.size() < capacity_) {
    values_ms_.push_back(value_ms);
  } else {
    values_ms_[next_] = value_ms;
  }
  next_ = (next_ + 1) % capacity_;
}

TimeSummary TimeWindow::summary() const {
  if (values_ms_.empty()) return {};
  auto sorted = values_ms_;
  std::sort(sorted.begin(), sorted.end());
  const auto count = static_cast<double>(sorted.size());
  const auto rank = [&](double share) {
    return sorted[static_cast<std::size_t>(std::max(0.0, std::ceil(share * count) - 1.0))];
  };
  return {std::accumulate(sorted.begin(), sorted.end(), 0.0) / count, rank(0.5), rank(0.99), sorted.back()};
}

}  // namespace laneloom
