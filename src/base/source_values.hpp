#pragma once

#include <string_view>

namespace laneloom {

/// Begins the name of a value that a source has in the status while it contradicts another one, whose name
/// follows. The value tells by how many metres its lines lie to the left of the other one's.
inline constexpr std::string_view kBesideSource = "beside_";

}  // namespace laneloom
