#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/messages.hpp"

namespace laneloom::service {

/// Summarises the last `capacity` durations. Does not allocate once it is full.
class TimeWindow {
 public:
  explicit TimeWindow(std::size_t capacity) : capacity_(capacity) { values_ms_.reserve(capacity); }

  void add(double value_ms);
  /// The summary of the durations. All values are 0 if nothing was added.
  TimeSummary summary() const;

 private:
  std::size_t capacity_;
  std::size_t next_ = 0;
  std::vector<double> values_ms_;
};

}  // namespace laneloom::service
