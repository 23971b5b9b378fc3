#pragma once

#include <string>
#include <string_view>

namespace laneloom::snapshot {

inline constexpr const char* kUnfinished = ".new";  ///< ends the name of a file that is not whole yet

/// Writes a file that only this user can read, and puts it in the place of `file` as a whole. It is safe in a
/// folder into which others may write. Throws std::runtime_error, also if a folder of the path is a link of
/// another user.
void replace_private_file(const std::string& file, std::string_view bytes);

/// The bytes of a regular file that belongs to this user or to root. Throws std::runtime_error for any other
/// file, for one that cannot be read, and if a folder of the path is a link of another user.
std::string read_private_file(const std::string& file);

}  // namespace laneloom::snapshot
