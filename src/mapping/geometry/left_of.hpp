#pragma once

#include "laneloom/types.hpp"

namespace laneloom::geometry {

/// A horizontal direction, turned to the left by a right angle.
inline Eigen::Vector2d left_of(const Eigen::Vector2d& direction) { return {-direction.y(), direction.x()}; }

/// The place `left_m` to the left of a point, for one who looks along `direction` (of unit length).
inline Point beside(const Point& point, const Eigen::Vector2d& direction, double left_m) {
  return point + left_m * Point(-direction.y(), direction.x(), 0.0);
}

}  // namespace laneloom::geometry
