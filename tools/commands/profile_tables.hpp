#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "commands/evaluation_tables.hpp"

namespace laneloom::commands {

/// A table of the median and the 90th percentile of the lateral errors of each marking type by distance. A
/// dash stands for no errors.
std::string profile_table(const std::vector<NamedEvaluation>& evaluations);

/// The same as JSON, under each name's "lateral_error", and the figures over range under its "range".
nlohmann::json profile_json(const std::vector<NamedEvaluation>& evaluations);

}  // namespace laneloom::commands
