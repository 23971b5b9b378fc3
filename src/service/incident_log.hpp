#pragma once

#include <cstdint>

#include "base/seconds.hpp"
#include "laneloom/counters.hpp"
#include "laneloom/messages.hpp"

namespace laneloom::service {

/// Logs the rise of counters that should not rise in normal operation. It does so once per period, so that no
/// message of others can flood the log.
class IncidentLog {
 public:
  explicit IncidentLog(double period_s) : period_ns_(nanoseconds(period_s)) {}

  void note(const ServiceStatus& status, std::int64_t now_ns);

 private:
  std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;
  Counters reported_;
};

}  // namespace laneloom::service
