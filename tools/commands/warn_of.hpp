#pragma once

#include <filesystem>
#include <stdexcept>

#include "base/left_out.hpp"
#include "laneloom/counters.hpp"

namespace laneloom::commands {

/// Warns on standard error if only a part of a file could be read: of refused messages, as "<topic>:
/// <reason>", and of a file that is cut off.
void warn_of(const std::filesystem::path& path, const Counters& refused, bool cut_off);

/// Warns on standard error of what is wrong in a file and was left out, if anything was.
void warn_of(const std::filesystem::path& path, const LeftOut& left_out);

/// Calls `read` with what it leaves out, and warns of that, also if nothing remains and it throws.
template <typename Read>
auto read_and_warn(const std::filesystem::path& path, bool strict, Read read) {
  LeftOut left_out(strict);
  try {
    auto result = read(left_out);
    warn_of(path, left_out);
    return result;
  } catch (const std::runtime_error&) {
    warn_of(path, left_out);
    throw;
  }
}

}  // namespace laneloom::commands
