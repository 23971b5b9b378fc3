#pragma once

#include <chrono>

namespace laneloom {

/// From now on, SIGINT and SIGTERM only ask the program to end.
void catch_stop_signals();

/// Whether it was asked. May be called from any thread.
bool stop_requested();

/// Sleeps until `deadline`, or until the program is to end; tells whether it may go on.
bool sleep_until(std::chrono::steady_clock::time_point deadline);

}  // namespace laneloom
