#include "batch/drives.hpp"

#include <glob.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string_view>

namespace laneloom::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> kSuffixes{".mcap", ".frames.jsonl", ".jsonl"};
constexpr std::size_t kOfFolders = 2;  // of a folder, files with these of the suffixes are drives

bool is_drive(const fs::path& path) {
  return std::any_of(kSuffixes.begin(), kSuffixes.begin() + kOfFolders,
                     [&](std::string_view suffix) { return path.string().ends_with(suffix); });
}

std::vector<fs::path> matches(const std::string& pattern) {
  glob_t found{};
  std::vector<fs::path> paths;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0)
    paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  return paths;
}

void add(const std::string& word, std::vector<fs::path>& drives) {
  const std::size_t before = drives.size();
  for (const fs::path& path : fs::exists(word) ? std::vector<fs::path>{word} : matches(word)) {
    if (!fs::is_directory(path)) {
      drives.push_back(path);
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file() && is_drive(entry.path())) drives.push_back(entry.path());
  }
  if (drives.size() == before) throw std::runtime_error(word + ": there is no such drive");
}

void add_list(const std::string& list, std::vector<fs::path>& drives) {
  std::ifstream file(list);
  if (!file) throw std::runtime_error(list + ": cannot be read");
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line.front() != '#') add((fs::path(list).parent_path() / line).string(), drives);
}

/// The innermost folder that has all drives below it.
fs::path common_folder(const std::vector<fs::path>& drives) {
  fs::path common = drives.front().parent_path();
  for (const fs::path& drive : drives) {
    const fs::path folder = drive.parent_path();
    fs::path shared;
    for (auto a = common.begin(), b = folder.begin(); a != common.end() && b != folder.end() && *a == *b;
         ++a, ++b)
      shared /= *a;
    common = shared;
  }
  return common;
}

std::string name_of(const fs::path& drive, const fs::path& below) {
  std::string name = drive.lexically_relative(below).string();
  for (const std::string_view suffix : kSuffixes)
    if (name.ends_with(suffix)) return name.substr(0, name.size() - suffix.size());
  return name;
}

}  // namespace

std::vector<Drive> find_drives(const std::vector<std::string>& words, const std::string& list) {
  std::vector<fs::path> paths;
  for (const std::string& word : words) add(word, paths);
  if (!list.empty()) add_list(list, paths);
  if (paths.empty()) throw std::runtime_error("no drive is named");
  for (fs::path& path : paths) path = fs::canonical(path);
  std::ranges::sort(paths);
  paths.erase(std::ranges::unique(paths).begin(), paths.end());
  const fs::path below = common_folder(paths);
  std::vector<Drive> drives;
  std::map<std::string, fs::path> by_name;
  for (const fs::path& path : paths) {
    drives.push_back({path, name_of(path, below)});
    const auto [other, is_new] = by_name.emplace(drives.back().name, path);
    if (!is_new)
      throw std::runtime_error(path.string() + " and " + other->second.string() + " would have one output");
  }
  return drives;
}

}  // namespace laneloom::batch
