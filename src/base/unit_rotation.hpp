#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace laneloom {

/// Whether a quaternion is a rotation, as exactly as messages and files have it. False for NaN.
inline bool is_unit(const Eigen::Quaterniond& rotation) { return std::abs(rotation.norm() - 1.0) <= 1e-3; }

}  // namespace laneloom
