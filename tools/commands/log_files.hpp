#pragma once

#include <filesystem>
#include <string>

namespace laneloom::commands {

/// The file for the output of a log. It is `path`. If the log is one of those below the `given` directory, it
/// is a file with the log's name in the folder `path`, which is made. Empty if `path` is.
inline std::string file_of_log(const std::string& path, const std::filesystem::path& given,
                               const std::filesystem::path& log, const std::string& ending) {
  if (path.empty() || log == given) return path;
  std::filesystem::create_directories(path);
  return std::filesystem::path(path) / (log.filename().string() + ending);
}

}  // namespace laneloom::commands
