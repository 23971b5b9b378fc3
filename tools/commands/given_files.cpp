#include "commands/given_files.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "io/text_file.hpp"

namespace laneloom::commands {
namespace {

/// Whether two paths name one file, which need not exist yet.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const auto whole = [&error](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
  };
  return whole(a) == whole(b) && !error;
}

/// Standard input and standard output are two files of one name.
std::vector<std::string> named(std::vector<std::string> files) {
  std::erase_if(files, [](const std::string& file) { return file.empty() || file == io::kStandard; });
  return files;
}

}  // namespace

void refuse_overwriting(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  const std::vector<std::string> read = named(inputs), written = named(outputs);
  for (auto path = written.begin(); path != written.end(); ++path) {
    const auto is_same = [&](const std::string& other) { return same_file(*path, other); };
    if (std::ranges::any_of(read, is_same))
      throw std::runtime_error(*path + ": is an input, and would be written over");
    if (std::any_of(written.begin(), path, is_same))
      throw std::runtime_error(*path + ": is given as an output twice");
  }
}

void refuse_second_reading(const std::vector<std::string>& inputs, const std::string& option) {
  const auto given = std::ranges::count(inputs, io::kStandard);
  if (given > 1) throw std::runtime_error("-: standard input can be read once, and is given twice");
  if (given == 1 && !option.empty())
    throw std::runtime_error("-: standard input can be read once, and " + option + " reads it twice");
}

}  // namespace laneloom::commands
