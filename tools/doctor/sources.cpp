#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "base/source_values.hpp"
#include "doctor/endpoints.hpp"
#include "doctor/findings.hpp"
#include "laneloom/limits.hpp"
#include "status/report.hpp"

namespace laneloom::doctor {
namespace {

/// The text for a writer.
std::string name_of(const Observed& seen, const dds::WriterId& writer) {
  const auto found = std::ranges::find(seen.endpoints, writer, &dds::Endpoint::id);
  return found == seen.endpoints.end() ? "one that is gone" : who(found->participant);
}

void judge_writers(const Observed& seen, const std::string& source, const InputObserved& frames,
                   Findings& found) {
  if (frames.mixed.empty()) return;
  std::vector<std::string> names;
  for (const dds::WriterId& writer : frames.mixed) names.push_back(name_of(seen, writer));
  std::ranges::sort(names);
  found.push_back(
      {"source_of_several_writers",
       fmt::format("{} writers take turns with detections of one source, \"{}\": {}.", names.size(), source,
                   fmt::join(names, ", ")),
       "A source has one session and one count. Each writer is taken for a restart of the other, or "
       "for a jump of the stamps, and frames of both are refused.",
       "Give each writer a name of its own (Detections.source), or end all but one of them."});
}

void judge_view(const std::string& source, const InputObserved& frames, Findings& found) {
  if (frames.without_view < frames.messages) return;
  found.push_back(
      {"no_field_of_view", fmt::format("Detections of source \"{}\" come without a field of view.", source),
       "Where nothing is seen, the mapper cannot tell a line that is gone from one out of sight.",
       "Fill Detections.field_of_view with what the sensors cover, and occluded_areas where they are "
       "blocked.",
       true});
}

/// Finds that a service drops all that a source detects, because its network is so unsure.
void judge_confidence(const ServiceObserved& service, const std::string& source, const InputObserved& frames,
                      Findings& found) {
  constexpr const char* kKey = "mapper.preprocess.min_confidence";
  const double least = std::strtod(status::setting(service.last, kKey).c_str(), nullptr);
  const bool drops = status::rises(service.last, service.first).contains("detections_unsure");
  if (!drops || frames.best_confidence < 0.0 || frames.best_confidence >= least) return;
  found.push_back(
      {"detections_unsure",
       fmt::format("All detections of source \"{}\" are below {} = {:g}; the surest has {:g}.", source, kKey,
                   least, frames.best_confidence),
       "The service drops them: nothing that this source sees is in the map, whose state is OK "
       "all the same.",
       fmt::format("See whether confidences go from 0 to 1. If the network is that unsure of lines "
                   "that are there, set {} to {:.3f}.",
                   kKey, 0.5 * frames.best_confidence),
       true});
}

/// The sources that a service heard while it was watched.
std::set<std::string> heard(const ServiceObserved& service) {
  std::set<std::string> result;
  for (const SourceStatus& source : service.last.sources) {
    const bool silent = std::ranges::any_of(service.first.sources, [&](const SourceStatus& before) {
      return before.source == source.source && before.session_id == source.session_id &&
             before.frames == source.frames;
    });
    if (!silent) result.insert(source.source);
  }
  return result;
}

void judge_number(const Observed& seen, Findings& found) {
  std::size_t most = seen.sources.size();
  for (const ServiceObserved& service : seen.services) most = std::max(most, heard(service).size());
  if (most <= kSourcesAtATime) return;
  found.push_back(
      {"too_many_sources",
       fmt::format("{} sources write detections; the service keeps {} apart.", most, kSourcesAtATime),
       "It forgets the one that is silent for longest, again and again: what was learned of that "
       "source is lost, and frames that come twice are taken twice.",
       "Use one name per perception stack, always the same (Detections.source). Where there are "
       "more stacks, join the detections of some of them in one writer."});
}

/// Finds the sources that a service leaves out because they contradict others.
void judge_agreement(const ServiceObserved& service, Findings& found) {
  for (const SourceStatus& source : service.last.sources) {
    for (const auto& [name, beside_m] : source.learned) {
      if (!name.starts_with(kBesideSource)) continue;
      found.push_back(
          {"sources_disagree",
           fmt::format("The lines of source \"{}\" lie {:.1f} m to the {} of those of source \"{}\".",
                       source.source, std::abs(beside_m), beside_m > 0.0 ? "left" : "right",
                       name.substr(kBesideSource.size())),
           "One of the two is wrong. The service maps only the one that was there first, because a map of "
           "both has every line twice.",
           "See how the sensors of both are calibrated, and whether both stamp by one clock; or end the one "
           "that is wrong."});
    }
  }
}

}  // namespace

Findings source_findings(const Observed& seen) {
  Findings found;
  for (const ServiceObserved& service : seen.services) judge_agreement(service, found);
  judge_number(seen, found);
  for (const auto& [source, frames] : seen.sources) {
    judge_writers(seen, source, frames, found);
    judge_view(source, frames, found);
    for (const ServiceObserved& service : seen.services) judge_confidence(service, source, frames, found);
  }
  return found;
}

}  // namespace laneloom::doctor
