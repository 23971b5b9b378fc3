#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/map_evaluation.hpp"

namespace laneloom {

using NamedEvaluation = std::pair<std::string, MapEvaluation>;

/// What goes beyond the score_table(): stability, average precision, trust, styles, linkages, stoplines. A
/// dash stands for what an input cannot tell.
std::string evaluation_tables(const std::vector<NamedEvaluation>& evaluations);

/// The same for machines, under each name; shares are 0..1, and what an input cannot tell is null.
nlohmann::json evaluation_json(const std::vector<NamedEvaluation>& evaluations);

}  // namespace laneloom
