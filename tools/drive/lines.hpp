#pragma once

#include "laneloom/polyline.hpp"

/// Operations of a planner on lines.
namespace laneloom::drive {

/// Prolongs a line at its end, in steps of `step_m`, with the curvature of its last metres, which fades. The
/// line must have a length.
void prolong(Polyline& line, double by_m, double step_m);

/// A bend from one point to another, which leaves and enters in the given unit directions, nearly as an arc.
/// Its points are at most half a metre apart.
Polyline bend_between(const Point& from, const Eigen::Vector2d& leaving, const Point& to,
                      const Eigen::Vector2d& entering);

}  // namespace laneloom::drive
