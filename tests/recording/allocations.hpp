#pragma once

#include <cstddef>

/// Memory of this process that `new` gave out.
namespace laneloom {

/// Starts to watch anew.
void watch_allocations();
/// The most that was in use at one time since then, beyond what was in use at the start.
std::size_t peak_bytes();

}  // namespace laneloom
