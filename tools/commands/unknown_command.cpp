#include "commands/unknown_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <utility>

#include "commands/program.hpp"

namespace laneloom::commands {
namespace {

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

std::string complaint(const CLI::App& app, const std::string& word) {
  const std::vector<const CLI::App*> commands = app.get_subcommands({});
  const auto edits = [&](const CLI::App* command) { return edits_between(word, command->get_name()); };
  const CLI::App* const nearest = *std::ranges::min_element(commands, {}, edits);
  return fmt::format("there is no command '{}'; the nearest is '{}', and --help lists all", word,
                     nearest->get_name());
}

}  // namespace

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
    if (named == commands.end()) return complaint(*within, word);
    within = *named;
  }
  return {};
}

}  // namespace laneloom::commands
