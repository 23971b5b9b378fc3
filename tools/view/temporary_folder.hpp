#pragma once

#include <filesystem>
#include <string>

namespace laneloom::view {

/// A folder that this user alone can enter, and that is removed with its content when this ends.
class TemporaryFolder {
 public:
  /// Throws std::runtime_error if the system gives none.
  TemporaryFolder();
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  ~TemporaryFolder();

  std::filesystem::path path(const std::string& file) const { return path_ / file; }

 private:
  std::filesystem::path path_;  ///< empty: it was moved from
};

}  // namespace laneloom::view
