#pragma once

#include "laneloom/polyline.hpp"

/// What a planner does with lines besides measuring them.
namespace laneloom {

/// From 0 to 1 without kinks, as `share` does.
double smooth_step(double share);

/// Adds what of `next` lies ahead of the end of `line`.
void append(Polyline& line, const Polyline& next);

/// Every point becomes that of a parabola through its neighbours (Savitzky-Golay, three metres either way for
/// points that are half a metre apart): takes noise away, and cuts no bend.
Polyline smoothed(const Polyline& line);

/// Prolongs a line at its end, in steps of `step_m`, with the curvature of its last metres, which fades. The
/// line has a length.
void prolong(Polyline& line, double by_m, double step_m);

/// From one point to another, leaving and entering in unit directions, nearly as an arc would; every half
/// metre or less.
Polyline bend_between(const Point& from, const Eigen::Vector2d& leaving, const Point& to,
                      const Eigen::Vector2d& entering);

/// The same from the end of one line to the beginning of another; empty where they (nearly) meet, or the
/// other begins before the first one's end.
Polyline bridge(const Polyline& from, const Polyline& to);

/// `line` until shortly before its end, from where it changes over to `other` and goes on along that.
Polyline change_over(const Polyline& line, const Polyline& other);

}  // namespace laneloom
