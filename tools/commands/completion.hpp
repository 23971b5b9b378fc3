#pragma once

namespace CLI {
class App;
}

namespace laneloom::commands {

/// Adds the command `completion`. It prints a script that makes a shell complete the commands and options of
/// `program`, whose other commands must all be registered.
void add_completion(CLI::App& program);

}  // namespace laneloom::commands
