#pragma once

namespace CLI {
class App;
}

namespace laneloom {

/// The command `completion`: prints what makes a shell complete the commands and options of `program`, whose
/// other commands are all registered.
void add_completion(CLI::App& program);

}  // namespace laneloom
