#include "doctor/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "doctor/endpoints.hpp"
#include "io/printable.hpp"

namespace laneloom::doctor {

using nlohmann::json;

std::string report(const Observed& seen, const Findings& found) {
  std::vector<std::string> names;
  std::ranges::transform(seen.participants, std::back_inserter(names), who);
  std::string text = io::printable(fmt::format(
      "Domain {}, vehicle \"{}\", watched for {:.1f} s: {} participants{}{}.", seen.dds.domain,
      seen.dds.vehicle_id, seen.duration_s, names.size(), names.empty() ? "" : ": ", fmt::join(names, ", ")));
  if (std::ranges::all_of(found, &Finding::advice)) text += "\nNothing wrong was found.";
  if (found.empty()) return text + "\n";
  text += "\n";
  for (std::size_t i = 0; i < found.size(); ++i)
    text += fmt::format("\n{}. {}{}\n   Why it matters: {}\n   What to do: {}\n", i + 1,
                        found[i].advice ? "Advice: " : "", io::printable(found[i].found),
                        io::printable(found[i].why), io::printable(found[i].remedy));
  return text;
}

json report_json(const Observed& seen, const Findings& found) {
  json participants = json::array(), findings = json::array();
  for (const dds::Peer& peer : seen.participants)
    participants.push_back({{"id", peer.id}, {"name", peer.name}, {"address", peer.address}});
  for (const Finding& finding : found)
    findings.push_back({{"id", finding.id},
                        {"found", finding.found},
                        {"why", finding.why},
                        {"remedy", finding.remedy},
                        {"advice", finding.advice}});
  return {{"domain", seen.dds.domain},
          {"vehicle_id", seen.dds.vehicle_id},
          {"duration_s", seen.duration_s},
          {"participants", participants},
          {"findings", findings}};
}

}  // namespace laneloom::doctor
