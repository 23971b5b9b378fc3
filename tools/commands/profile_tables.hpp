#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "commands/evaluation_tables.hpp"

namespace laneloom {

/// Median and 90 % of the lateral errors of each marking type by distance; a dash where there are none.
std::string profile_table(const std::vector<NamedEvaluation>& evaluations);

/// The same for machines, under each name's "lateral_error", and the figures over range under its "range".
nlohmann::json profile_json(const std::vector<NamedEvaluation>& evaluations);

}  // namespace laneloom
