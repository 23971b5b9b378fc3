#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/evaluation.hpp"

namespace laneloom::commands {

using NamedScore = std::pair<std::string, evaluation::MapScore>;

/// A table with one line per kind and score: precision, recall, F1 (per cent), ACD (metres) and the counts.
std::string score_table(const std::vector<NamedScore>& scores);

/// The same as JSON. Shares are 0..1.
nlohmann::json score_json(const std::vector<NamedScore>& scores);

}  // namespace laneloom::commands
