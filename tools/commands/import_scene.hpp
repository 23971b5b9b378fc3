#pragma once

namespace CLI {
class App;
}

namespace laneloom::commands {

/// Adds `laneloom import scene` to the command `import`.
void add_import_scene(CLI::App& app);

}  // namespace laneloom::commands
