#pragma once

#include <string>

namespace laneloom::service {

/// Makes the log of the process. If standard error is connected to the journal, the log goes there with
/// priorities; otherwise it goes to standard error with times.
void set_up_log(const std::string& level);

/// Prints an error of one or more lines on standard error, before there is a log. If that is the journal, the
/// lines have a priority.
void print_error(const std::string& text);

/// Sets the least severe level that is logged: "debug", "info", "warn", "error" or "off".
void set_log_level(const std::string& level);

}  // namespace laneloom::service
