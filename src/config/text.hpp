#pragma once

#include <array>
#include <charconv>
#include <string>

namespace laneloom::config {

/// The shortest text that reads back as the same number, whatever the locale.
inline std::string to_text(double value) {
  std::array<char, 32> buffer{};
  char* const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

inline std::string range_text(double min, double max) { return to_text(min) + " .. " + to_text(max); }

}  // namespace laneloom::config
