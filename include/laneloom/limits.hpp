#pragma once

#include <cstddef>

namespace laneloom {

/// Sources of detections that a service keeps apart at a time. A further one takes the place of one that is
/// silent, and is refused while all of them go on.
inline constexpr std::size_t kSourcesAtATime = 8;

}  // namespace laneloom
