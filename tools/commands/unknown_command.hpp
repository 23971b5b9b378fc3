#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace laneloom {

struct Program;

/// Where these words name a command that there is not: a complaint that names it, and the program that has
/// it, or the nearest that there is. Else empty.
std::string unknown_command(const CLI::App& app, const Program& program,
                            const std::vector<std::string>& words);

}  // namespace laneloom
