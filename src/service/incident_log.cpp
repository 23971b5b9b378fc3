#include "service/incident_log.hpp"

#include <spdlog/spdlog.h>

#include <string_view>

namespace laneloom::service {
namespace {

bool is_incident(std::string_view counter) {
  return counter.find("_refused_") != std::string_view::npos ||
         counter.find("_dropped_") != std::string_view::npos || counter.ends_with("_lost") ||
         counter == "map_resets" || counter == "pose_jumps" || counter == "sources_restarted" ||
         counter == "frames_thinned" || counter == "lines_forgotten" || counter == "ticks_missed" ||
         counter == "ticks_out_of_time" || counter == "elements_left_out" || counter == "writes_failed" ||
         counter == "snapshots_failed";
}

}  // namespace

void IncidentLog::note(const ServiceStatus& status, std::int64_t now_ns) {
  if (now_ns < next_ns_) return;
  next_ns_ = now_ns + period_ns_;
  Counters seen;
  for (const auto& [counter, total] : status.counters) {
    seen.add(counter, total);
    const auto before = reported_[counter];
    // A total may also fall: a message that was taken for lost may still come.
    if (total > before && is_incident(counter)) {
      spdlog::warn("counter={} new={} total={}", counter, total - before, total);
    }
  }
  reported_ = seen;
}

}  // namespace laneloom::service
