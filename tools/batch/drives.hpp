#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// One step of work on many drives.
namespace laneloom::batch {

/// A recorded drive.
struct Drive {
  std::filesystem::path path;    ///< absolute
  std::filesystem::path folder;  ///< above it
  std::string name;              ///< of its outputs: the path below the folder, without the suffix
};

/// What lies before this in a word is the folder above its drives.
inline constexpr const char* kNamesBegin = "/./";

/// The drives that are meant by words: files, folders (all recordings and frames below, also through links),
/// and patterns with * and ?. Of a folder, files that a batch with these `outputs` made are no drives. `list`
/// names a file with one such word a line; empty: none. Relative paths in it are those of its folder.
///
/// A folder is above its drives, as the folder of a file is, that of a list for the relative paths below it,
/// and that before the first * or ? of a pattern. Of several, it is the innermost one that has all of them
/// below it: names depend on the words, and not on the drives that they mean. The drives are sorted by path,
/// each of them once. Throws std::runtime_error naming the word that means no drive, unless it is of the
/// list, where drives may have gone since, or two drives that have one name.
std::vector<Drive> find_drives(const std::vector<std::string>& words, const std::string& list,
                               const std::filesystem::path& outputs);

}  // namespace laneloom::batch
