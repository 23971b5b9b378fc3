#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace laneloom::io {

/// A folder that this user alone can enter, and that is removed with its content when this ends.
class WorkFolder {
 public:
  /// Throws std::runtime_error where it cannot be made.
  WorkFolder() : path_((std::filesystem::temp_directory_path() / "laneloom_XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) throw std::runtime_error(path_ + ": cannot be made");
  }
  WorkFolder(WorkFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  WorkFolder& operator=(WorkFolder&&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }

  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;  ///< empty: it was moved from
};

}  // namespace laneloom::io
