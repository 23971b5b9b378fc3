#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace laneloom::commands {

/// One of the two programs.
struct Program {
  std::string name;
  std::string description;
  /// Each registers one command; see commands.hpp and lab_commands.hpp.
  std::vector<void (*)(CLI::App&)> commands;
  std::string other;                        ///< the other program
  std::vector<std::string> other_commands;  ///< its commands, which users may look for here
};

/// Runs the command of the command line, and prints errors on standard error. Returns the exit code
/// (exit_codes.hpp).
int run_program(const Program& program, int argc, char** argv);

}  // namespace laneloom::commands
