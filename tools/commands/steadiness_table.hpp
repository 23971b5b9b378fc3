#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "evaluation/steadiness.hpp"

namespace laneloom::commands {

/// A table of what a planner takes from the maps of a drive. A dash stands for a value that cannot be told.
/// Without maps the table is empty.
std::string steadiness_table(const evaluation::Steadiness& steadiness);

/// The same as JSON. Shares are 0..1; a value that cannot be told is null.
nlohmann::json steadiness_json(const evaluation::Steadiness& steadiness);

}  // namespace laneloom::commands
