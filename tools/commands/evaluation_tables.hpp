#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/map_evaluation.hpp"

namespace laneloom::commands {

using NamedEvaluation = std::pair<std::string, evaluation::MapEvaluation>;

/// Tables of the measures beyond score_table(): stability, average precision, trust, styles, linkages,
/// stoplines, what a planner takes. A dash stands for a value that an input cannot tell.
std::string evaluation_tables(const std::vector<NamedEvaluation>& evaluations);

/// The same as JSON, under each name. Shares are 0..1; a value that an input cannot tell is null.
nlohmann::json evaluation_json(const std::vector<NamedEvaluation>& evaluations);

}  // namespace laneloom::commands
