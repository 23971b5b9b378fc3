#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

namespace laneloom::config {

/// The shortest text that reads back as the same number, whatever the locale. It has no exponent, because the
/// loader does not take a text with an exponent for a whole number.
inline std::string to_text(double value) {
  std::array<char, 400> buffer{};  // long enough for any number
  char* const end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed).ptr;
  return {buffer.data(), end};
}

inline std::string range_text(double min, double max) { return to_text(min) + " .. " + to_text(max); }

/// Unit and range of a number.
struct Limits {
  const char* unit;  ///< empty: it has none
  double min, max;
};

/// The text at a position among texts that '|' separates. Empty: the position is beyond the last one.
inline std::string choice_at(std::string_view choices, std::size_t index) {
  for (; index > 0; --index) {
    const auto bar = choices.find('|');
    if (bar == std::string_view::npos) return "";
    choices.remove_prefix(bar + 1);
  }
  return std::string(choices.substr(0, choices.find('|')));
}

/// The position of a text among texts that '|' separates. If it is not among them, the number of texts.
inline std::size_t choice_index(std::string_view choices, std::string_view text) {
  const auto count = static_cast<std::size_t>(std::ranges::count(choices, '|')) + 1;
  for (std::size_t index = 0; index < count; ++index)
    if (choice_at(choices, index) == text) return index;
  return count;
}

inline bool is_choice(std::string_view choices, std::string_view text) {
  return choice_index(choices, text) <= static_cast<std::size_t>(std::ranges::count(choices, '|'));
}

}  // namespace laneloom::config
