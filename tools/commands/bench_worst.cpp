#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/worst_frames.hpp"
#include "commands/bench.hpp"
#include "commands/time_table.hpp"
#include "config/config_file.hpp"

namespace laneloom::commands {
namespace {

struct BenchWorstOptions {
  std::string config;
  std::uint64_t frames = 50;
  bool as_json = false;
};

void worst(const BenchWorstOptions& options) {
  const Config config = config::resolve_config(options.config, {});
  nlohmann::json result;
  if (!options.as_json) print_time_header("milliseconds");
  for (const bench::WorstKind kind : bench::kWorstKinds) {
    const TimeSummary time = time_worst(config, kind, options.frames);
    result[name(kind)] = to_json(time);
    if (!options.as_json) print_time_row(name(kind), time);
  }
  if (options.as_json) fmt::print("{}\n", result.dump());
}

}  // namespace

void add_bench_worst(CLI::App& bench) {
  CLI::App* command =
      bench.add_subcommand("worst", "Times the most expensive frames that a message can hold, by kind");
  const auto options = std::make_shared<BenchWorstOptions>();
  command->add_option("--config", options->config, "Configuration file; its gate bounds the work");
  command->add_option("--frames", options->frames, "Frames of each kind")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "One JSON object");
  command->callback([options] { worst(*options); });
}

}  // namespace laneloom::commands
