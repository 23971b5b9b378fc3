#include <fmt/format.h>

#include <map>
#include <string_view>

#include "check/findings.hpp"
#include "mapping/trails/vehicles.hpp"
#include "session/gate.hpp"

namespace laneloom::check {

Findings object_findings(const std::vector<TrackedObjects>& objects, const GateConfig& gate) {
  std::map<std::string_view, std::size_t> refused;
  trails::MovingObjects moving;
  for (const TrackedObjects& message : objects) {
    if (const std::string_view why = session::defect(message, gate); !why.empty()) {
      ++refused[why];
      continue;
    }
    moving += trails::moving_objects(message);
  }
  Findings found;
  for (const auto& [why, count] : refused)
    found.push_back(
        {"objects_refused",
         fmt::format("{} of {} messages of objects are refused as '{}'.", count, objects.size(), why),
         "Mend what writes them. deploy/README.md tells what is meant."});
  if (moving.leave_no_trail())
    found.push_back(
        {"objects_leave_no_trail",
         fmt::format("Of {} moving objects, {} have no heading, and {} are of unknown kind or not sure: none "
                     "leaves a trail.",
                     moving.useless(), moving.without_heading, moving.doubted),
         "See what idl/README.md says of heading, kind, existence_probability and position_stddev_m.",
         /*advice=*/true});
  return found;
}

}  // namespace laneloom::check
