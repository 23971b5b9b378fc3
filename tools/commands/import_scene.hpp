#pragma once

namespace CLI {
class App;
}

namespace laneloom {

/// Adds `laneloom import scene`, of which add_import() is.
void add_import_scene(CLI::App& app);

}  // namespace laneloom
