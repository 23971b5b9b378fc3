#include "batch/drives.hpp"

#include <glob.h>

#include <algorithm>
#include <array>
#include <deque>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "batch/outputs.hpp"
#include "io/text_file.hpp"

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

fs::path whole(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

/// The folder below which a word names its drives.
fs::path folder_of(const std::string& word) {
  if (const std::size_t mark = word.find(kNamesBegin); mark != std::string::npos)
    return whole(word.substr(0, mark + 1));
  if (fs::is_directory(word)) return whole(word);
  const std::size_t pattern = fs::exists(word) ? std::string::npos : word.find_first_of("*?[");
  return whole(word.substr(0, pattern) + "x").parent_path();
}

struct Found {
  fs::path folder;  ///< below which the word named it
  fs::path path;
};

/// Finds the drives that words mean.
class Search {
 public:
  explicit Search(const fs::path& outputs) : outputs_(fs::weakly_canonical(whole(outputs))) {}

  void add(const std::string& word, bool of_list = false) {
    const std::size_t before = found_.size();
    const fs::path folder = folder_of(word);
    for (const fs::path& path : fs::exists(word) ? std::vector<fs::path>{word} : matches(word)) {
      if (!fs::is_directory(path)) {
        found_.push_back({folder, whole(path)});
        continue;
      }
      add_below(whole(path), folder);
    }
    if (found_.size() > before) return;
    if (!of_list) throw std::runtime_error(word + ": there is no such drive");
    found_.push_back({folder, whole(word)});  // it fails, and stops no other
  }

  /// A relative path of a list names the drive below the list's folder.
  void add_list(const std::string& list) {
    std::ifstream file(list);
    if (!file) throw std::runtime_error(list + ": cannot be read");
    const std::string folder = fs::path(list).parent_path().string();
    for (std::string line; io::next_line(file, line);) {
      if (line.empty() || line.front() == '#') continue;
      const bool below = !fs::path(line).is_absolute() && !line.starts_with("..");
      add(below ? (folder.empty() ? "." : folder) + kNamesBegin + line : (fs::path(folder) / line).string(),
          /*of_list=*/true);
    }
  }

  const std::vector<Found>& found() const { return found_; }

 private:
  /// Links to folders come behind all others: a folder is looked into once, under its own name if it has one.
  void add_below(const fs::path& top, const fs::path& folder) {
    std::deque<fs::path> ahead{top};
    for (std::set<fs::path> seen; !ahead.empty();) {
      const fs::path at = ahead.front(), real = fs::canonical(at);
      ahead.pop_front();
      if (!seen.insert(real).second) continue;
      for (const fs::path& path : std::set<fs::path>(fs::directory_iterator(at), {})) {
        std::error_code of_broken_link;
        if (fs::is_directory(path, of_broken_link))
          ahead.insert(fs::is_symlink(path) ? ahead.end() : ahead.begin(), path);
        else if (is_drive(path) && !is_output(outputs_, real / path.filename()))
          found_.push_back({folder, path});  // where nothing is behind a link, it fails
      }
    }
  }

  fs::path outputs_;
  std::vector<Found> found_;
};

/// The innermost folder that has all folders below it, or is one of them.
fs::path common_folder(const std::vector<Found>& drives) {
  fs::path common = drives.front().folder;
  for (const Found& drive : drives)
    while (*drive.folder.lexically_relative(common).begin() == "..") common = common.parent_path();
  return common;
}

std::string name_of(const fs::path& drive, const fs::path& below) {
  std::string name = drive.lexically_relative(below).string();
  for (const std::string_view suffix : kSuffixes)
    if (name.ends_with(suffix)) return name.substr(0, name.size() - suffix.size());
  return name;
}

}  // namespace

std::vector<Drive> find_drives(const std::vector<std::string>& words, const std::string& list,
                               const fs::path& outputs) {
  Search search(outputs);
  for (const std::string& word : words) search.add(word);
  if (!list.empty()) search.add_list(list);
  if (search.found().empty()) throw std::runtime_error("no drive is named");
  const fs::path below = common_folder(search.found());
  std::map<fs::path, std::string> names;
  for (const Found& found : search.found()) names.emplace(found.path, name_of(found.path, below));
  std::vector<Drive> drives;
  std::map<std::string, fs::path> by_name;
  for (const auto& [path, name] : names) {
    drives.push_back({path, below, name});
    const auto [other, is_new] = by_name.emplace(name, path);
    if (!is_new)
      throw std::runtime_error(path.string() + " and " + other->second.string() + " would have one output");
  }
  return drives;
}

}  // namespace laneloom::batch
