#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace laneloom {

/// Size and time of a file that may be too large to read once more. Other ones tell of another content. There
/// need be no file.
inline std::string file_stamp(const std::string& file) {
  std::error_code unknown;
  const auto size = std::filesystem::file_size(file, unknown);
  const auto time = std::filesystem::last_write_time(file, unknown);
  return std::to_string(size) + " " + std::to_string(time.time_since_epoch().count());
}

}  // namespace laneloom
