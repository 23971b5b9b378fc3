#pragma once

#include <chrono>

namespace laneloom::commands {

/// Lets SIGINT and SIGTERM only ask the program to end, from now on.
void catch_stop_signals();

/// Whether the program was asked to end. May be called from any thread.
bool stop_requested();

/// Sleeps until `deadline`, or until the program is asked to end. Returns whether it may go on.
bool sleep_until(std::chrono::steady_clock::time_point deadline);

}  // namespace laneloom::commands
