#include "read_text.hpp"

#include <cstdint>
#include <fstream>
#include <sstream>
#include <system_error>

#include "laneloom/error.hpp"

namespace laneloom::config {
namespace {

constexpr std::uintmax_t kMaxFileBytes = 1 << 20;

}  // namespace

std::string read_text(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw ConfigError(path.string() + ": is not a readable file");
  if (std::filesystem::file_size(path, error) > kMaxFileBytes)
    throw ConfigError(path.string() + ": is too large");
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw ConfigError(path.string() + ": can not be read");
  return text.str();
}

}  // namespace laneloom::config
