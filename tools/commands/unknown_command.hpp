#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace laneloom::commands {

struct Program;

/// If the words name an unknown command, a complaint that names it, and the program that has it or the most
/// similar command. Otherwise empty.
std::string unknown_command(const CLI::App& app, const Program& program,
                            const std::vector<std::string>& words);

}  // namespace laneloom::commands
