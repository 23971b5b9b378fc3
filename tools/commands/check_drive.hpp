#pragma once

#include <string>

#include "laneloom/config.hpp"

namespace laneloom::commands {

/// What is wrong with a drive, as text: why little may have come of it. Empty: nothing, as far as it can be
/// told. Without warnings. Throws as open_messages().
std::string why_poor(const std::string& path, const Config& config);

}  // namespace laneloom::commands
