#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace laneloom {

/// Where these words name a command that there is not: a complaint that names it, and the nearest that there
/// is. Else empty.
std::string unknown_command(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace laneloom
