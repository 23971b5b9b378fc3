#pragma once

#include <string>

#include "check/findings.hpp"
#include "laneloom/config.hpp"

namespace laneloom::commands {

/// What is wrong with a drive, as text: why little may have come of it. Empty: nothing, as far as it can be
/// told. Without warnings. Throws as open_messages().
std::string why_poor(const std::string& path, const Config& config);

/// The same of a recording that was imported, and if so, that too little is driven to tell. Remedies name
/// `command_for`, which made the recording.
std::string doubts_of_import(const std::string& recording,
                             const check::CommandFor& command_for = check::import_frames_command);

}  // namespace laneloom::commands
