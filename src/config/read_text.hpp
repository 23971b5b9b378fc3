#pragma once

#include <filesystem>
#include <string>

namespace laneloom::config {

/// Throws ConfigError naming a file that cannot be read, or is larger than 1 MB.
std::string read_text(const std::filesystem::path& path);

}  // namespace laneloom::config
