#pragma once

#include "drive/bicycle.hpp"
#include "laneloom/polyline.hpp"

/// From a path to what the vehicle does next.
namespace laneloom {

/// Of a path at an arc length, to the left, 1/m; as a mean over `max_reach_m` either way, or half of
/// a shorter path. The path has a length.
double curvature_at(const MeasuredPolyline& path, double arc_m, double max_reach_m = 2.0);

/// Steers `vehicle` along a path (which begins beside or behind it), at `speed_mps` at most, and so slowly
/// that the lateral acceleration stays bounded in the bends ahead.
///
/// A law of curvature: that of the path a moment ahead, minus what takes offset and angle from the path away
/// over a distance that grows with speed. The path has a length.
Command follow(const MeasuredPolyline& path, const Bicycle& vehicle, double speed_mps);

}  // namespace laneloom
