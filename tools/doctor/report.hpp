#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "doctor/findings.hpp"

namespace laneloom::doctor {

/// A text for people, with the participants that were seen and the findings.
std::string report(const Observed& seen, const Findings& found);
/// The same as an object for machines.
nlohmann::json report_json(const Observed& seen, const Findings& found);

}  // namespace laneloom::doctor
