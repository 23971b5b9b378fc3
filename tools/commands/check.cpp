#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "check/findings.hpp"
#include "commands/check_drive.hpp"
#include "commands/commands.hpp"
#include "commands/exit_codes.hpp"
#include "commands/given_files.hpp"
#include "commands/options.hpp"
#include "commands/read_input.hpp"
#include "commands/warn_of.hpp"
#include "config/config_file.hpp"
#include "io/json_text.hpp"
#include "io/printable.hpp"
#include "io/text_file.hpp"
#include "replay/message_source.hpp"

namespace laneloom::commands {
namespace {

struct CheckOptions {
  std::string drive, config, out;
  bool json = false;
};

nlohmann::json report_json(const check::Findings& found) {
  nlohmann::json list = nlohmann::json::array();
  for (const check::Finding& finding : found)
    list.push_back({{"id", finding.id},
                    {"found", finding.found},
                    {"remedy", finding.remedy},
                    {"advice", finding.advice}});
  return {{"findings", list}};
}

/// The findings, numbered.
std::string list_of(const check::Findings& found) {
  std::string text;
  for (std::size_t i = 0; i < found.size(); ++i)
    text += fmt::format("{}. {}{}\n   What to do: {}\n", i + 1, found[i].advice ? "Advice: " : "",
                        io::printable(found[i].found), io::printable(found[i].remedy));
  return text;
}

bool is_sound(const check::Findings& found) { return std::ranges::all_of(found, &check::Finding::advice); }

void check(const CheckOptions& options) {
  refuse_overwriting({options.drive, options.config}, {options.out});
  const Config config = config::resolve_config(options.config, {});
  const auto source = replay::open_messages(options.drive, config.dds.map_frame_id,
                                            {.conventions = {.any_confidence = true}});
  const check::Drive drive = read_inputs(*source);
  check::Findings found = left_out_findings(drive, source->left_out());
  std::ranges::move(findings(drive, config), std::back_inserter(found));
  warn_of(options.drive, source->refused(), source->left_out());
  const auto json = [&] { return io::json_text(report_json(found)) + "\n"; };
  if (!options.out.empty()) io::write_text(options.out, json());
  if (options.json)
    fmt::print("{}", json());
  else
    fmt::print("{}{}", is_sound(found) ? options.drive + ": nothing wrong was found.\n" : "", list_of(found));
  if (!is_sound(found)) end_with(kFoundWrong);
}

check::Drive drive_of(const std::string& path, const Config& config) {
  const auto source =
      replay::open_messages(path, config.dds.map_frame_id, {.conventions = {.any_confidence = true}});
  return read_inputs(*source);
}

std::string told(const std::string& path, const check::Findings& found) {
  return found.empty() ? "" : "laneloom: " + path + ": `laneloom check` finds:\n" + list_of(found);
}

}  // namespace

std::string why_poor(const std::string& path, const Config& config) {
  if (path == io::kStandard) return {};  // standard input was read
  check::Findings found = findings(drive_of(path, config), config);
  std::erase_if(found, &check::Finding::advice);
  return told(path, found);
}

std::string doubts_of_import(const std::string& recording, const check::CommandFor& command_for) {
  const Config config;
  check::Findings found = findings(drive_of(recording, config), config, command_for);
  // Without it, silence would be taken for agreement.
  std::erase_if(found, [](const check::Finding& one) { return one.advice && one.id != check::kTooLittle; });
  return told(recording, found);
}

void add_check(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "check", "Tells whether the detections and poses of a drive fit together, and what is wrong");
  command->footer(fmt::format("Exit code: {} where something wrong was found.", +kFoundWrong));
  const auto options = std::make_shared<CheckOptions>();
  command
      ->add_option("--in,drive", options->drive, "Recording (MCAP), or detections and poses (.frames.jsonl)")
      ->required();
  command->add_option("--config", options->config, "Configuration (.yaml), whose limits are looked at, too");
  command->add_flag("--json", options->json, "One JSON object");
  add_text_output(*command, "--out", options->out, "Findings to write, too (.json)");
  command->callback([options] { check(*options); });
}

}  // namespace laneloom::commands
