#include "commands/completion.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace laneloom::commands {
namespace {

/// A word that may stand on a command line.
struct Word {
  std::string text;
  std::string description;
  std::vector<std::string> values;  ///< values that may follow it; empty: any
};

/// A command, with the words that may follow it.
struct Command {
  std::string path;  ///< " bench latency"; empty: the program
  std::vector<Word> commands, options;
  std::vector<std::string> values;  ///< of an argument without a name
};

/// The values that CLI::IsMember lets pass. Its help text for them is "TEXT:{a,b}".
std::vector<std::string> values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find(":{");
  if (open == std::string::npos || type.back() != '}') return {};
  return CLI::detail::split(type.substr(open + 2, type.size() - open - 3), ',');
}

/// Adds the options of a command, also those of its groups, which are commands without a name.
void add_options(const CLI::App& app, Command& command) {
  for (const CLI::Option* option : app.get_options()) {
    const std::vector<std::string> values = values_of(*option);
    for (const std::string& name : option->get_lnames())
      command.options.push_back({"--" + name, option->get_description(), values});
    if (option->get_positional()) command.values.insert(command.values.end(), values.begin(), values.end());
  }
  for (const CLI::App* group : app.get_subcommands({}))
    if (group->get_name().empty()) add_options(*group, command);
}

void collect(const CLI::App& app, const std::string& path, std::vector<Command>& all) {
  Command command{.path = path};
  add_options(app, command);
  for (const CLI::App* inner : app.get_subcommands({}))
    if (!inner->get_name().empty())
      command.commands.push_back({inner->get_name(), inner->get_description(), {}});
  all.push_back(command);
  for (const Word& inner : command.commands)
    collect(*app.get_subcommand(inner.text), path + " " + inner.text, all);
}

std::string quoted(std::string text) {
  for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 4)
    text.replace(at, 1, "'\\''");
  return "'" + text + "'";
}

/// The part that both shells have in common: it finds the command that the words before the cursor name.
std::string find_command(const std::vector<Command>& all) {
  std::string text = "    case \"$at $word\" in\n";
  for (const Command& command : all)
    if (!command.path.empty()) text += fmt::format("      {0}) at={0} ;;\n", quoted(command.path));
  return text + "    esac\n";
}

/// One case per option with known values. `offer` makes the shell's command that offers them.
template <class Offer>
std::string offer_values(const std::vector<Command>& all, Offer offer) {
  std::string text;
  for (const Command& command : all)
    for (const Word& option : command.options)
      if (!option.values.empty())
        text += fmt::format("    {}) {}; return ;;\n", quoted(command.path + " " + option.text),
                            offer(option.values));
  return text;
}

/// The words, each in quotes, with spaces between.
std::string quoted(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += " " + quoted(word);
  return text;
}

std::string bash_script(const std::string& program, const std::vector<Command>& all) {
  std::string words;
  for (const Command& command : all) {
    std::string line;
    for (const Word& word : command.commands) line += word.text + " ";
    for (const std::string& value : command.values) line += value + " ";
    for (const Word& word : command.options) line += word.text + " ";
    words += fmt::format("    {}) words={} ;;\n", quoted(command.path), quoted(line));
  }
  const auto offer = [](const std::vector<std::string>& values) {
    return fmt::format("mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$current\")", fmt::join(values, " "));
  };
  std::string function = program;
  std::ranges::replace(function, '-', '_');
  return fmt::format(R"(_{0}() {{
  local at='' word words current=${{COMP_WORDS[COMP_CWORD]}}
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
{1}  done
  case "$at ${{COMP_WORDS[COMP_CWORD-1]}}" in
{2}  esac
  case $at in
{3}  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -o default -F _{0} {4}
)",
                     function, find_command(all), offer_values(all, offer), words, program);
}

std::string zsh_script(const std::string& program, const std::vector<Command>& all) {
  const auto offer = [](const std::vector<std::string>& values) { return "compadd --" + quoted(values); };
  const auto item = [](const Word& word) { return quoted(word.text + ":" + word.description) + " "; };
  std::string words;
  for (const Command& command : all) {
    std::string line;
    for (const Word& word : command.commands) line += item(word);
    for (const std::string& value : command.values) line += quoted(value) + " ";
    for (const Word& word : command.options) line += item(word);
    words += fmt::format("    {}) offered=({}) ;;\n", quoted(command.path), line);
  }
  return fmt::format(R"(#compdef {0}
_{0}() {{
  local at='' word
  local -a offered
  for word in "${{(@)words[2,CURRENT-1]}}"; do
{1}  done
  case "$at ${{words[CURRENT-1]}}" in
{2}  esac
  case $at in
{3}  esac
  _describe {0} offered || _files
}}
compdef _{0} {0}
)",
                     program, find_command(all), offer_values(all, offer), words);
}

}  // namespace

void add_completion(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "completion", "Prints a script that makes a shell complete commands and options");
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "The shell")->required()->check(CLI::IsMember({"bash", "zsh"}));
  command->footer(fmt::format("For the shell that runs: source <({} completion bash)", program.get_name()));
  command->callback([&program, shell] {
    std::vector<Command> all;
    collect(program, "", all);
    const auto script = *shell == "bash" ? bash_script : zsh_script;
    fmt::print("{}", script(program.get_name(), all));
  });
}

}  // namespace laneloom::commands
