#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/messages.hpp"

namespace laneloom {

/// The last `capacity` durations, to be summarised. Does not allocate after it is full.
class TimeWindow {
 public:
  explicit TimeWindow(std::size_t capacity) : capacity_(capacity) { values_ms_.reserve(capacity); }

  void add(double value_ms);
  /// All zero when nothing was added.
  TimeSummary summary() const;

 private:
  std::size_t capacity_;
  std::size_t next_ = 0;
  std::vector<double> values_ms_;
};

}  // namespace laneloom
