#include "commands/live_display.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace laneloom::commands {

bool LiveDisplay::is_a_terminal() { return isatty(STDOUT_FILENO) == 1; }

void LiveDisplay::print_line(const std::string& line) {
  drawn_lines_ = 0;
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

void LiveDisplay::redraw(const std::string& text) {
  if (drawn_lines_ > 0) fmt::print("\x1b[{}A\x1b[J", drawn_lines_);
  drawn_lines_ = std::count(text.begin(), text.end(), '\n');
  fmt::print("{}", text);
  std::fflush(stdout);
}

}  // namespace laneloom::commands
