#include <utility>

#include "check/findings.hpp"
#include "doctor/findings.hpp"

namespace laneloom::doctor {

Findings fit_findings(const Observed& seen, const MapperConfig& mapper) {
  Findings found;
  for (check::Finding& finding : check::fit_findings(seen.drive, mapper)) {
    if (finding.advice || finding.id == "sensor_left") continue;
    found.push_back({"fit_" + finding.id, std::move(finding.found),
                     "Frames do not agree on where the road is: the map has few lanes, or wrong ones.",
                     "Mend it where it is written. `laneloom check` on a recording tells more, and "
                     "`laneloom import frames` tries the remedy on it."});
  }
  return found;
}

}  // namespace laneloom::doctor
