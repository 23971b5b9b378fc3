#pragma once

#include <filesystem>

#include "base/left_out.hpp"
#include "laneloom/counters.hpp"

namespace laneloom::commands {

/// Warns on standard error if only a part of a file could be read: of refused messages, as "<topic>:
/// <reason>", and of a file that is cut off.
void warn_of(const std::filesystem::path& path, const Counters& refused, bool cut_off);

/// Warns on standard error of what is wrong in a file and was left out, if anything was.
void warn_of(const std::filesystem::path& path, const LeftOut& left_out);

}  // namespace laneloom::commands
