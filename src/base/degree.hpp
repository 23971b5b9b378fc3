#pragma once

#include <numbers>

namespace laneloom {

inline constexpr double kDegree = std::numbers::pi / 180.0;  ///< rad

}  // namespace laneloom
