#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace laneloom {

/// The number of the last domain that DDS has.
inline constexpr int kLastDomain = 232;

/// Why a text is no name of a vehicle or of a frame. Empty: it is one.
inline std::string identifier_problem(const std::string& text) {
  // '*' and '?' would be wildcards in the name of a DDS partition.
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./").find(c) != std::string_view::npos;
  };
  if (!text.empty() && text.size() <= 64 && std::ranges::all_of(text, allowed)) return {};
  return "\"" + text + "\" is not 1 to 64 letters, digits, '_', '-', '.' or '/'";
}

}  // namespace laneloom
