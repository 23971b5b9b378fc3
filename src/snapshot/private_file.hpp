#pragma once

#include <string>
#include <string_view>

namespace laneloom {

/// Writes a file that only this user reads, and puts it in the place of `file` as a whole; also where others
/// may write into the folder. Throws std::runtime_error, also where a folder of the path is a link of another
/// user.
void replace_private_file(const std::string& file, std::string_view bytes);

/// The bytes of a regular file that belongs to this user or to root. Throws std::runtime_error for any other,
/// for one that cannot be read, and likewise for a link in the path.
std::string read_private_file(const std::string& file);

}  // namespace laneloom
