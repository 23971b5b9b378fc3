#pragma once

#include <cstddef>

namespace laneloom {

/// Sources of detections that a service keeps apart at a time. Of more, it forgets the one that is idle for
/// longest.
inline constexpr std::size_t kSourcesAtATime = 8;

}  // namespace laneloom
