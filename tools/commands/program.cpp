#include "commands/program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>

#include "commands/completion.hpp"
#include "commands/exit_codes.hpp"
#include "commands/unknown_command.hpp"

namespace laneloom::commands {
namespace {

void tell(const Program& program, const std::string& complaint) {
  std::fprintf(stderr, "%s: %s\n", program.name.c_str(), complaint.c_str());
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
  const std::vector<std::string> words{argv + std::min(1, argc), argv + argc};
  const std::string complaint = unknown_command(app, program, words);
  if (!complaint.empty()) {
    tell(program, complaint);
    return kWrongUse;
  }
  try {
    app.parse(argc, argv);
    return kDone;
  } catch (const CLI::RuntimeError& end) {  // thrown by end_with()
    return end.get_exit_code();
  } catch (const CLI::Error& error) {  // also thrown for --help
    return app.exit(error) == 0 ? kDone : kWrongUse;
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
