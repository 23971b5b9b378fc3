#pragma once

#include <string>

#include "laneloom/config.hpp"
#include "laneloom/messages.hpp"

namespace laneloom::commands {

/// The configuration of a service (YAML), as a status in the drive `path` told it. Throws ConfigError naming
/// the file if it has keys that this laneloom does not know.
std::string told_configuration(const std::string& path, const ServiceStatus& status);

/// The configuration that made the maps of a drive (YAML): as the writer of the recording tells it, or else
/// as a service told it in its first status. Empty: neither tells it, or the drive is no recording. Throws
/// ConfigError naming the file if the service had keys that this laneloom does not know.
std::string recorded_configuration(const std::string& path);

/// The same, read; the defaults, where it is not told. Throws ConfigError also if the writer had other keys.
Config recorded_config(const std::string& path);

}  // namespace laneloom::commands
