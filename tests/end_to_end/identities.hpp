#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "temporary_folder.hpp"

namespace laneloom {

/// Identities of a certificate authority of their own, made with tools/make-certificates. Removed in the end.
class Identities {
 public:
  using Edit = std::function<void(const std::filesystem::path& project)>;

  /// `edit` may change a copy of the tool and of config/security before. Throws std::runtime_error when they
  /// can't be made.
  explicit Identities(const Edit& edit = {}, const std::vector<std::string>& options = {});

  /// The folder that holds a folder for each identity; there is room for more.
  const std::filesystem::path& folder() const { return folder_; }
  /// `config` of one who has this identity.
  DdsConfig as(const std::string& identity, DdsConfig config) const;

 private:
  const TemporaryFolder base_;
  const std::filesystem::path folder_ = base_.file("security");
};

std::string text_of(const std::filesystem::path& file);
/// Replaces every `from`. Throws std::runtime_error when there is none.
void replace_in(const std::filesystem::path& file, const std::string& from, const std::string& to);

}  // namespace laneloom
