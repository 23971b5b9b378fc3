#pragma once

#include <cstddef>

namespace laneloom {

/// Number of sources of detections that a service keeps apart at a time. A further source takes the place of
/// one that fell silent. It is refused while all the others go on sending.
inline constexpr std::size_t kSourcesAtATime = 8;

}  // namespace laneloom
