#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands/exit_codes.hpp"
#include "commands/lab_commands.hpp"
#include "commands/options.hpp"
#include "commands/stop_signal.hpp"
#include "endurance/soak.hpp"

namespace laneloom::commands {
namespace {

struct SoakOptions {
  endurance::SoakSpec spec;
  double minutes = 1.0;
  double recovery_s = 5.0;
  std::vector<std::string> perceptions;
};

void print(const endurance::SoakResult& result) {
  fmt::print("| {:<24} | times | planner's recovery at most, s |\n|---|---|---|\n", "fault");
  for (const auto& [fault, count] : result.faults)
    fmt::print("| {:<24} | {:>5} | {:>29.1f} |\n", fault, count.times, count.longest_recovery_s);
  fmt::print("\n| {:<20} | published | fused | refused | dropped | pending | lost | unexplained |\n",
             "session of the service");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  for (const auto& [session, account] : result.accounts) {
    fmt::print("| {:<22} | {:>9} | {:>5} | {:>7} | {:>7} | {:>7} | {:>4} | {:>11} |\n", session,
               account.published, account.fused, account.refused, account.dropped, account.pending,
               account.lost, account.unexplained());
  }
  fmt::print("\n{} maps, {} missed, {} contract violations; {} datagrams refused\n", result.maps.received,
             result.maps.missed, result.maps.violations.size(), result.refused_datagrams);
  for (const auto& violation : result.maps.violations) fmt::print("violation: {}\n", violation);
  for (const auto& failure : result.failures) fmt::print("{}\n", failure);
  fmt::print("{}\n", result.passed() ? "passed" : "FAILED");
}

void run(SoakOptions& options) {
  catch_stop_signals();
  endurance::SoakSpec& spec = options.spec;
  spec.duration = std::chrono::duration<double>(60.0 * options.minutes);
  spec.fleet.perceptions.assign(options.perceptions.begin(), options.perceptions.end());
  spec.recovery = std::chrono::duration<double>(options.recovery_s);
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  spec.fleet.command = folder / "laneloom";
  spec.fleet.service = folder / "laneloomd";
  spec.fleet.dds.vehicle_id = fmt::format("soak_{}", getpid());  // apart from every other vehicle
  const endurance::SoakResult result = soak(spec, [] { return !stop_requested(); });
  print(result);
  if (!result.passed()) end_with(kFoundWrong);
}

}  // namespace

void add_soak(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("soak",
                         "Runs publisher, service, planner, other perceptions and a stranger under "
                         "random faults, and accounts for every frame");
  const auto options = std::make_shared<SoakOptions>();
  command->add_option("--minutes", options->minutes, "Minutes to run")
      ->check(within(1e-3, 1e6))
      ->capture_default_str();
  command->add_option("--seed", options->spec.seed, "Seed of the faults")->capture_default_str();
  command->add_option("--perception", options->perceptions,
                      "One more perception, run as PROGRAM DOMAIN VEHICLE_ID FILE (tests/interop has two)");
  command->add_option(
      "--stranger", options->spec.fleet.stranger,
      "A program that sends damaged datagrams to the service, and the captures that it makes them "
      "of (tests/end_to_end has it, tests/dds/captures those)");
  command->add_option("--recovery", options->recovery_s, "Longest wait of the planner for a map, in seconds")
      ->check(positive_seconds())
      ->capture_default_str();
  command->add_option("--domain", options->spec.fleet.dds.domain, "DDS domain")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  command->footer(
      "Exit code 2: a frame is not accounted for, a map broke the contract, no good one came after a fault "
      "(to the planner in time), a process ended by itself, or one that was told to end crashed or hung.");
  command->callback([options] { run(*options); });
}

}  // namespace laneloom::commands
