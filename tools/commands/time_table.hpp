#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "support/stage_timer.hpp"

namespace laneloom::commands {

/// Print rows of a table of milliseconds on standard output.
void print_time_header(const std::string& title);
void print_time_row(const std::string& name, const TimeSummary& time);
/// Prints a row for each stage that was reached.
void print_stage_rows(const support::StageTimer& timer);

/// {"mean", "p50", "p99", "max"}, in milliseconds.
nlohmann::json to_json(const TimeSummary& time);
/// Such objects by the names of the stages that were reached.
nlohmann::json to_json(const support::StageTimer& timer);

}  // namespace laneloom::commands
