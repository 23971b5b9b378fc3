#include "endurance/account.hpp"

#include <iterator>
#include <string_view>

namespace laneloom::endurance {
namespace {

std::uint64_t published_within(const SourceStatus& source, const support::PublicationLog& log) {
  if (log.session_id != source.session_id) return 0;
  const auto first = log.times_ns.lower_bound(source.first_sequence);
  const auto last = log.times_ns.upper_bound(source.last_sequence);
  return static_cast<std::uint64_t>(std::distance(first, last));
}

}  // namespace

Account account_of(const ServiceStatus& last, const std::vector<SourceStatus>& sources,
                   const std::vector<support::PublicationLog>& logs) {
  Account account;
  for (const auto& source : sources) {
    for (const auto& log : logs) account.published += published_within(source, log);
  }
  account.pending = last.pending_frames;
  for (const auto& [name, count] : last.counters) {
    if (name == "frames_fused") account.fused = count;
    if (name == "frames_dropped_queue_full") account.dropped = count;
    if (name == "detections_lost") account.lost = count;
    if (name.starts_with("detections_refused_")) account.refused += count;
  }
  return account;
}

}  // namespace laneloom::endurance
