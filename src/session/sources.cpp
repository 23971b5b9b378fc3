#include "session/sources.hpp"

#include <algorithm>

#include "laneloom/limits.hpp"

namespace laneloom::session {
namespace {

constexpr std::int64_t kIdle_ns = 2'000'000'000;  // not longer: a stack may take a new name with every run
constexpr std::size_t kStampsRemembered = 64;

}  // namespace

Sources::Verdict Sources::check(const DetectionFrame& frame, std::int64_t arrival_ns) {
  Source* const found = find_or_add(frame.source, arrival_ns);
  if (found == nullptr) {
    crowded_out_ns_ = arrival_ns;
    return {"too_many_sources"};
  }
  Source& source = *found;
  const Gate::Verdict verdict = source.gate.check({frame.stamp_ns, frame.session_id});
  const bool seen = std::ranges::find(source.stamps_ns, frame.stamp_ns) != source.stamps_ns.end();
  const bool begins_anew = verdict == Gate::Verdict::begins_anew;
  const bool restarted = begins_anew && source.progress.session_id != frame.session_id;
  if (verdict == Gate::Verdict::outlier) return {"outlier"};
  if (verdict == Gate::Verdict::repeated || (seen && !begins_anew)) return {"repeated"};
  if (begins_anew) {
    source.stamps_ns.clear();
    // After a jump of the stamps within one session, the count goes on.
    source.progress = {.source = frame.source, .fused = restarted ? 0 : source.progress.fused};
  }
  source.stamps_ns.push_back(frame.stamp_ns);
  if (source.stamps_ns.size() > kStampsRemembered) source.stamps_ns.pop_front();
  source.progress.session_id = frame.session_id;
  source.progress.period_ns = std::min(arrival_ns - source.progress.arrival_ns, kLongestPeriod_ns);
  source.progress.arrival_ns = arrival_ns;
  return {.refusal = {}, .restarted = restarted};
}

void Sources::note_fused(const DetectionFrame& frame, std::int64_t arrival_ns) {
  const auto found = sources_.find(frame.source);
  if (found == sources_.end()) return;
  SourceProgress& progress = found->second.progress;
  ++progress.fused;
  progress.fused_stamp_ns = std::max(progress.fused_stamp_ns.value_or(frame.stamp_ns), frame.stamp_ns);
  progress.fused_arrival_ns = arrival_ns;
}

std::vector<SourceProgress> Sources::progress() const {
  std::vector<SourceProgress> all;
  for (const auto& [name, source] : sources_) all.push_back(source.progress);
  return all;
}

Sources::Source* Sources::find_or_add(const std::string& name, std::int64_t arrival_ns) {
  const auto found = sources_.find(name);
  if (found != sources_.end()) return &found->second;
  if (!make_room(arrival_ns)) return nullptr;
  return &sources_.emplace(name, Source{Gate(config_), {.source = name}, {}}).first->second;
}

bool Sources::make_room(std::int64_t arrival_ns) {
  if (sources_.size() < kSourcesAtATime) return true;
  const auto last_heard_ns = [](const auto& entry) { return entry.second.progress.arrival_ns; };
  const auto idle = std::ranges::min_element(sources_, {}, last_heard_ns);
  if (arrival_ns - last_heard_ns(*idle) <= kIdle_ns) return false;
  sources_.erase(idle);
  return true;
}

}  // namespace laneloom::session
