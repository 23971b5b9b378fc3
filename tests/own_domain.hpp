#pragma once

#include <unistd.h>

namespace laneloom {

/// The DDS domain of this process, most likely no other's. The ports of higher domains are the system's to
/// give away.
inline int own_domain() { return 1 + getpid() % 90; }

}  // namespace laneloom
