#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace laneloom::endurance {

/// Waits until a planner (laneloom pnc --json), whose output goes to `file`, prints a map that is not STALE
/// and has a frame from after `since_ns` (sensors' clock) in it. False: it did not within `patience`.
bool wait_for_planner(const std::string& file, std::int64_t since_ns, std::chrono::milliseconds patience);

}  // namespace laneloom::endurance
