#include "commands/program.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "commands/completion.hpp"
#include "commands/exit_codes.hpp"
#include "io/printable.hpp"

namespace laneloom::commands {
namespace {

void tell(const Program& program, const std::string& complaint) {
  std::fprintf(stderr, "%s: %s\n", program.name.c_str(), io::printable(complaint).c_str());
}

/// The words of the command line. `help COMMAND` becomes `COMMAND --help`.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words{argv + std::min(1, argc), argv + argc};
  if (!words.empty() && words.front() == "help") {
    std::rotate(words.begin(), words.begin() + 1, words.end());
    words.back() = "--help";
  }
  return words;
}

/// The number of letters to insert, remove or change (Levenshtein's distance).
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);  // from the first letters of a to each beginning of b
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::vector<std::size_t> next{i + 1};
    for (std::size_t j = 0; j < b.size(); ++j)
      next.push_back(std::min({row[j] + (a[i] == b[j] ? 0 : 1), row[j + 1] + 1, next[j] + 1}));
    row = std::move(next);
  }
  return row[b.size()];
}

std::string no_such_command(const CLI::App& app, const std::string& word) {
  const std::vector<const CLI::App*> commands = app.get_subcommands({});
  const auto edits = [&](const CLI::App* command) { return edits_between(word, command->get_name()); };
  const CLI::App* const nearest = *std::ranges::min_element(commands, {}, edits);
  return fmt::format("there is no command '{}'; the nearest is '{}', and --help lists all", word,
                     nearest->get_name());
}

/// If the words name an unknown command, a complaint that names it, and the program that has it or the most
/// similar command. Otherwise empty.
std::string unknown_command(const CLI::App& app, const Program& program,
                            const std::vector<std::string>& words) {
  if (!words.empty() && std::ranges::count(program.other_commands, words.front()) > 0)
    return fmt::format("'{}' is a command of {}: {} {}", words.front(), program.other, program.other,
                       words.front());
  const CLI::App* within = &app;
  for (const std::string& word : words) {
    if (word.starts_with('-') || within->get_require_subcommand_min() == 0) return {};
    const std::vector<const CLI::App*> commands = within->get_subcommands({});
    const auto named = std::ranges::find(commands, word, [](const CLI::App* c) { return c->get_name(); });
    if (named == commands.end()) return no_such_command(*within, word);
    within = *named;
  }
  return {};
}

/// Tells what is wrong with the use of a command, and how it is used. Returns the exit code.
int tell_use(const CLI::App& app, const CLI::Error& error) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().back();
  std::string path;  // of the commands around it
  for (const CLI::App* part = command->get_parent(); part != nullptr; part = part->get_parent())
    path.insert(0, part->get_name() + " ");
  const std::string help = command->help(path.substr(0, path.empty() ? 0 : path.size() - 1));
  path += command->get_name();
  const std::size_t usage = help.find("Usage: ");
  std::fprintf(stderr, "%s: %s\n%s\n`%s --help` tells more.\n", path.c_str(), error.what(),
               help.substr(usage, help.find('\n', usage) - usage).c_str(), path.c_str());
  return kWrongUse;
}

int run(const Program& program, int argc, char** argv) {
  CLI::App app(program.description, program.name);
  app.set_version_flag("--version", LANELOOM_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done; 1 it failed; 2 something wrong was found; 3 nobody was heard; 4 nothing to drive "
      "on; 64 no such command, option or value.");
  for (const auto add : program.commands) add(app);
  add_completion(app);
  std::vector<std::string> words = words_of(argc, argv);
  const std::string complaint = unknown_command(app, program, words);
  if (!complaint.empty()) {
    tell(program, complaint);
    return kWrongUse;
  }
  try {
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app.parse(std::move(words));
    return kDone;
  } catch (const CLI::RuntimeError& end) {  // thrown by end_with()
    return end.get_exit_code();
  } catch (const CLI::Error& error) {  // also thrown for --help
    return error.get_exit_code() == 0 ? app.exit(error) : tell_use(app, error);
  }
}

int run_and_tell(const Program& program, int argc, char** argv) {
  try {
    return run(program, argc, argv);
  } catch (const std::exception& error) {
    tell(program, error.what());
    return kFailed;
  }
}

/// Whether all output was written. A full disk shows at the latest when the output is flushed.
bool printed() { return std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

}  // namespace

int run_program(const Program& program, int argc, char** argv) {
  const int code = run_and_tell(program, argc, argv);
  if (printed()) return code;
  tell(program, "standard output cannot be written");
  return code == kDone ? kFailed : code;
}

}  // namespace laneloom::commands
