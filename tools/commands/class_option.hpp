#pragma once

#include <CLI/CLI.hpp>

#include "io/json_lines.hpp"

namespace laneloom::commands {

/// Adds --class NAME=TYPE, once for each class.
CLI::Option* add_classes(CLI::App& command, io::Classes& classes);

}  // namespace laneloom::commands
