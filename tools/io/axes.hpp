#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace laneloom::io {

/// Takes points to the body's axes (x forward, y left, z up), from axes that are told by the directions of
/// their x and y, and of z where that is not up: "right-forward", "right-down-forward". The directions are
/// forward, backward, left, right, up and down, of different lines; the axes may be left-handed. Throws
/// std::invalid_argument if the name is none of these.
Eigen::Matrix3d axes_named(const std::string& name);

/// The names of level axes, those that are met more often first, and of a camera's axes.
const std::vector<std::string>& axes_names();

}  // namespace laneloom::io
