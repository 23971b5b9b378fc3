#pragma once

#include <filesystem>

#include "laneloom/counters.hpp"

namespace laneloom {

/// On standard error, where only a part of a file could be read: messages that were passed over, as
/// "<topic>: <reason>", and whether the file ends before its end.
void warn_of(const std::filesystem::path& path, const Counters& refused, bool cut_off);

}  // namespace laneloom
