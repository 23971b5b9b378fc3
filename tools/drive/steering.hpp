#pragma once

#include "drive/bicycle.hpp"
#include "laneloom/polyline.hpp"

/// Steers a vehicle along a path.
namespace laneloom::drive {

/// The curvature of a path at an arc length, to the left, in 1/m. It is a mean over `max_reach_m` either way,
/// or half of a shorter path. The path must have a length.
double curvature_at(const MeasuredPolyline& path, double arc_m, double max_reach_m = 2.0);

/// Steers `vehicle` along a path, which begins beside or behind it. The speed is at most `speed_mps`, and so
/// low that the lateral acceleration stays bounded in the bends ahead.
///
/// The curvature is that of the path a moment ahead, minus a term that takes away offset and angle from the
/// path over a distance that grows with speed. The path must have a length.
Command follow(const MeasuredPolyline& path, const Bicycle& vehicle, double speed_mps);

}  // namespace laneloom::drive
