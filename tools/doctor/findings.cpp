#include "doctor/findings.hpp"

#include <algorithm>
#include <utility>

namespace laneloom::doctor {

Findings findings(const Observed& seen) {
  Findings all = presence_findings(seen);
  // Two services, or two readers of one participant, may give the same finding.
  const auto add = [&](Findings more) {
    for (Finding& finding : more)
      if (std::ranges::find(all, finding.found, &Finding::found) == all.end())
        all.push_back(std::move(finding));
  };
  if (!seen.participants.empty()) {
    add(topic_findings(seen));
    add(ros_findings(seen));
    add(qos_findings(seen));
    add(stream_findings(seen));
    add(source_findings(seen));
    add(incident_findings(seen));
    add(state_findings(seen));
  }
  add(shared_memory_findings(seen));
  std::stable_partition(all.begin(), all.end(), [](const Finding& finding) { return !finding.advice; });
  return all;
}

}  // namespace laneloom::doctor
