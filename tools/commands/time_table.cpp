#include "commands/time_table.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace laneloom::commands {

void print_time_header(const std::string& title) {
  fmt::print("{:<24} {:>9} {:>9} {:>9} {:>9}\n", title, "mean", "p50", "p99", "max");
}

void print_time_row(const std::string& name, const TimeSummary& time) {
  fmt::print("{:<24} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f}\n", name, time.mean_ms, time.p50_ms, time.p99_ms,
             time.max_ms);
}

void print_stage_rows(const support::StageTimer& timer) {
  for (std::size_t i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (timer.reached(stage)) print_time_row(name(stage), timer.stage(stage));
  }
}

nlohmann::json to_json(const TimeSummary& time) {
  return {{"mean", time.mean_ms}, {"p50", time.p50_ms}, {"p99", time.p99_ms}, {"max", time.max_ms}};
}

nlohmann::json to_json(const support::StageTimer& timer) {
  nlohmann::json json = nlohmann::json::object();
  for (std::size_t i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (timer.reached(stage)) json[name(stage)] = to_json(timer.stage(stage));
  }
  return json;
}

}  // namespace laneloom::commands
