#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace laneloom {

/// Which map of which session of the service.
struct MapNumber {
  std::uint64_t session_id = 0;
  std::uint64_t sequence = 0;
};

/// Waits until a planner (laneloom pnc --json), whose output goes to `file`, prints a map that is not STALE
/// and is later than `newest`, or of another session; false: not within `patience`.
bool wait_for_planner(const std::string& file, const MapNumber& newest, std::chrono::seconds patience);

}  // namespace laneloom
