#include "session/sources.hpp"

#include <algorithm>

#include "laneloom/limits.hpp"

namespace laneloom {
namespace {

constexpr std::size_t kStampsRemembered = 64;

}  // namespace

Sources::Verdict Sources::check(const DetectionFrame& frame, std::int64_t arrival_ns) {
  Source& source = sources_.try_emplace(frame.source, Source{Gate(config_), {.source = frame.source}, {}, 0})
                       .first->second;
  const Gate::Verdict verdict = source.gate.check({frame.stamp_ns, frame.session_id});
  const bool seen = std::ranges::find(source.stamps_ns, frame.stamp_ns) != source.stamps_ns.end();
  const bool restarted = verdict == Gate::Verdict::begins_anew;
  if (verdict == Gate::Verdict::outlier) return {"outlier"};
  if (verdict == Gate::Verdict::repeated || (seen && !restarted)) return {"repeated"};
  if (restarted) {
    source.stamps_ns.clear();
    // After a jump of the stamps the session is the same, and so is what it counts.
    const bool same = source.progress.session_id == frame.session_id;
    source.progress = {.source = frame.source, .fused = same ? source.progress.fused : 0};
  }
  source.stamps_ns.push_back(frame.stamp_ns);
  if (source.stamps_ns.size() > kStampsRemembered) source.stamps_ns.pop_front();
  source.progress.session_id = frame.session_id;
  source.progress.arrival_ns = arrival_ns;
  source.accepted = ++accepted_;
  forget_idle();
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

void Sources::forget_idle() {
  if (sources_.size() <= kSourcesAtATime) return;  // a stack may take a new name with every run
  sources_.erase(
      std::ranges::min_element(sources_, {}, [](const auto& entry) { return entry.second.accepted; }));
}

}  // namespace laneloom
