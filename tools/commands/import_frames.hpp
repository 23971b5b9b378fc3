#pragma once

namespace CLI {
class App;
}

namespace laneloom::commands {

/// Registers `laneloom import frames`.
void add_import_frames(CLI::App& import);

}  // namespace laneloom::commands
