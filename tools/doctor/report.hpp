#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "doctor/findings.hpp"

namespace laneloom {

/// For people: who was seen, and each finding.
std::string report(const Observed& seen, const Findings& found);
/// The same for machines.
nlohmann::json report_json(const Observed& seen, const Findings& found);

}  // namespace laneloom
