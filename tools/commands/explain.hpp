#pragma once

#include <string>

#include "laneloom/config.hpp"

namespace laneloom::commands {

/// Prints why a drive's map has an element: `wanted` is ID@TIME, or dN@TIME for detection N, with seconds
/// since the first map. Throws std::runtime_error if there is no such time, or nothing of that id.
void explain(const std::string& drive, const Config& config, const std::string& wanted);

}  // namespace laneloom::commands
