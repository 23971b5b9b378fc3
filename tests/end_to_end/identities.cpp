#include "identities.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "process.hpp"

namespace laneloom {

namespace fs = std::filesystem;

Identities::Identities(const Edit& edit, const std::vector<std::string>& options) {
  const fs::path base = base_.path(), source = LANELOOM_SOURCE_DIR;
  fs::create_directories(base / "config");
  fs::create_directories(base / "tools");
  fs::copy(source / "config/security", base / "config/security", fs::copy_options::recursive);
  fs::copy(source / "tools/make-certificates", base / "tools");
  if (edit) edit(base);

  std::vector<std::string> command{base / "tools/make-certificates", "--out", folder_};
  command.insert(command.end(), options.begin(), options.end());
  Process process(command);
  if (process.wait() != 0) throw std::runtime_error(process.errors());
}

DdsConfig Identities::as(const std::string& identity, DdsConfig config) const {
  config.security_directory = folder_ / identity;
  return config;
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = text_of(file);
  auto at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("no " + from + " in " + file.string());
  for (; at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
  std::ofstream(file) << text;
}

}  // namespace laneloom
