#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace laneloom::io {

inline constexpr std::string_view kEmpty = "is empty";
inline constexpr std::string_view kXml = "is XML";
inline constexpr std::string_view kUtf16 = "is text in UTF-16, not in UTF-8";  ///< readers of XML take both

/// What a file is by its first bytes, as "is compressed with zstd" or "is empty". Empty: it is a text, or
/// nothing known, or cannot be read.
std::string file_kind(const std::filesystem::path& path);

}  // namespace laneloom::io
