#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/commands.hpp"
#include "commands/exit_codes.hpp"
#include "commands/options.hpp"
#include "commands/stop_signal.hpp"
#include "config/config_file.hpp"
#include "doctor/observer.hpp"
#include "doctor/report.hpp"
#include "io/json_text.hpp"

namespace laneloom::commands {
namespace {

struct DoctorOptions {
  Config config;
  std::string config_problem;
  double duration_s = 3.0;
  bool json = false;
};

/// Reads the configuration file. Options given beside it are parsed after it, and thereby override it.
void read_config(const std::string& file, DoctorOptions& options) {
  try {
    options.config = config::load_config(file);
  } catch (const ConfigError& error) {
    options.config_problem = error.what();
  }
}

doctor::Finding refused_configuration(const std::string& problem) {
  return {"configuration", fmt::format("The configuration is refused: {}.", problem),
          "The service does not start with it. Nothing else was looked at.",
          "Mend it; `laneloomd --config FILE --check-config` checks it again."};
}

doctor::Finding refused_participant(const std::string& problem) {
  return {"participant", fmt::format("No participant can be made: {}.", problem),
          "Others with these settings can't take part either. Nothing else was looked at.",
          "Mend the key that is named, or see what Fast DDS wrote above."};
}

/// The observations and the findings in them.
std::pair<doctor::Observed, doctor::Findings> examine(const DoctorOptions& options) {
  doctor::Observed seen;
  seen.dds = options.config.dds;
  if (!options.config_problem.empty()) return {seen, {refused_configuration(options.config_problem)}};
  try {
    const doctor::Observer observer(options.config.dds);
    const auto duration = std::chrono::milliseconds(std::llround(options.duration_s * 1e3));
    sleep_until(std::chrono::steady_clock::now() + duration);
    seen = observer.observed();
  } catch (const std::exception& error) {
    return {seen, {refused_participant(error.what())}};
  }
  const doctor::Findings found = findings(seen);
  if (!std::ranges::all_of(found, &doctor::Finding::advice)) return {seen, found};
  doctor::Findings all = fit_findings(seen, options.config.mapper);
  std::ranges::copy(found, std::back_inserter(all));
  return {seen, all};
}

void doctor(const DoctorOptions& options) {
  catch_stop_signals();
  const auto [seen, found] = examine(options);
  if (options.json)
    fmt::print("{}\n", io::json_text(report_json(seen, found)));
  else
    fmt::print("{}", report(seen, found));
  if (!std::ranges::all_of(found, &doctor::Finding::advice)) end_with(kFoundWrong);
}

}  // namespace

void add_doctor(CLI::App& app) {
  CLI::App* command = app.add_subcommand("doctor", "Finds why nothing arrives");
  command->footer(fmt::format("Exit code: {} where something wrong was found.", +kFoundWrong));
  const auto options = std::make_shared<DoctorOptions>();
  command
      ->add_option_function<std::string>(
          "--config", [options](const std::string& file) { read_config(file, *options); },
          "Configuration of the service, checked too; its section dds says where to look")
      ->trigger_on_parse();
  add_dds(*command, options->config.dds);
  command->add_option("--duration", options->duration_s, "Seconds to watch")
      ->check(within(1.0, 3600.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "One JSON object");
  command->callback([options] { doctor(*options); });
}

}  // namespace laneloom::commands
