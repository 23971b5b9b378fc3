#pragma once

#include <algorithm>
#include <string>

namespace laneloom::io {

/// A name that others gave themselves, without characters that control a terminal.
inline std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; },
      '?');
  return text;
}

}  // namespace laneloom::io
