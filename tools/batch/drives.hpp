#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// One step of work on many drives.
namespace laneloom::batch {

/// A recorded drive.
struct Drive {
  std::filesystem::path path;
  /// Names its outputs: the path below the folder that all drives have in common, without the suffix. It may
  /// have folders.
  std::string name;
};

/// The drives that are meant by words: files, folders (all recordings and frames below), and patterns with *
/// and ?. `list` names a file with one such word a line; empty: none. Relative paths in it are those of its
/// folder. The drives are sorted by path, each of them once. Throws std::runtime_error naming the word that
/// means no drive, or two drives that have one name.
std::vector<Drive> find_drives(const std::vector<std::string>& words, const std::string& list);

}  // namespace laneloom::batch
