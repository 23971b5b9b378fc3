#pragma once

#include <filesystem>
#include <stdexcept>

#include "base/left_out.hpp"
#include "laneloom/counters.hpp"

namespace laneloom::commands {

/// Warns on standard error of what is wrong in a file and was left out, if anything was.
void warn_of(const std::filesystem::path& path, const LeftOut& left_out);

/// The same of a recording, and of its messages that were refused, by "<topic>: <reason>".
void warn_of(const std::filesystem::path& path, const Counters& refused, const LeftOut& left_out);

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
