#pragma once

#include <string>

namespace laneloom {

/// Makes the log of the process: to the journal, with priorities, where standard error is connected to it,
/// and to standard error, with times, elsewhere.
void set_up_log(const std::string& level);

/// An error before there is a log, in one or more lines on standard error; with a priority where that is the
/// journal.
void print_error(const std::string& text);

/// "debug", "info", "warn", "error" or "off".
void set_log_level(const std::string& level);

}  // namespace laneloom
