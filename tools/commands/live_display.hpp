#pragma once

#include <cstddef>
#include <string>

namespace laneloom::commands {

/// Standard output, where a text can be drawn in place of the one before if it is a terminal.
class LiveDisplay {
 public:
  bool is_terminal() const { return terminal_; }

  /// Prints a line that stays; the next text is drawn below it.
  void print_line(const std::string& line);
  /// Draws a text in place of the one before. `text` ends with a line feed, and no line of it is longer than
  /// the terminal is wide.
  void redraw(const std::string& text);

 private:
  static bool is_a_terminal();

  bool terminal_ = is_a_terminal();
  std::ptrdiff_t drawn_lines_ = 0;
};

}  // namespace laneloom::commands
