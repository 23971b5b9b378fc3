#pragma once

#include <filesystem>
#include <system_error>

#include "io/text_file.hpp"

namespace laneloom::io {

/// Removes a file that was made in vain. Standard output and devices stay.
inline void discard(const std::filesystem::path& path) {
  std::error_code unknown;
  if (path != kStandard && std::filesystem::is_regular_file(path, unknown))
    std::filesystem::remove(path, unknown);
}

/// Does `work`, which makes a file. If it throws, a file that was not there before is removed: what is half
/// done would be in the way of the next attempt.
template <typename Work>
void make_file(const std::filesystem::path& path, Work work) {
  std::error_code unknown;
  const bool was_there = std::filesystem::exists(path, unknown);
  try {
    work();
  } catch (...) {
    if (!was_there) discard(path);
    throw;
  }
}

}  // namespace laneloom::io
