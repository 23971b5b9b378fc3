#pragma once

#include "laneloom/polyline.hpp"

/// Operations of a planner on lines.
namespace laneloom::drive {

/// Appends the part of `next` that lies ahead of the end of `line`.
void append(Polyline& line, const Polyline& next);

/// Replaces every point by that of a parabola fitted to its neighbours (Savitzky-Golay, three metres either
/// way for points that are half a metre apart). This removes noise, and cuts no bend.
Polyline smoothed(const Polyline& line);

/// Prolongs a line at its end, in steps of `step_m`, with the curvature of its last metres, which fades. The
/// line must have a length.
void prolong(Polyline& line, double by_m, double step_m);

/// A bend from one point to another, which leaves and enters in the given unit directions, nearly as an arc.
/// Its points are at most half a metre apart.
Polyline bend_between(const Point& from, const Eigen::Vector2d& leaving, const Point& to,
                      const Eigen::Vector2d& entering);

/// A bend from the end of one line to the beginning of another. Empty: they (nearly) meet, or the other
/// begins before the end of the first.
Polyline bridge(const Polyline& from, const Polyline& to);

/// `line` until shortly before its end, then a change over to `other`, and `other` from there on.
Polyline change_over(const Polyline& line, const Polyline& other);

}  // namespace laneloom::drive
