#pragma once

#include <filesystem>
#include <string>

namespace laneloom {

/// Where to write what is made of a log: to `path`; where the log is one below the `given` directory, to a
/// file of the log's name in the folder `path`, which is made. Nowhere where `path` is empty.
inline std::string file_of_log(const std::string& path, const std::filesystem::path& given,
                               const std::filesystem::path& log, const std::string& ending) {
  if (path.empty() || log == given) return path;
  std::filesystem::create_directories(path);
  return std::filesystem::path(path) / (log.filename().string() + ending);
}

}  // namespace laneloom
