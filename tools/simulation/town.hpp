#pragma once

#include "simulation/road.hpp"

namespace laneloom::simulation {

/// A round of about 1.7 km, driven counter-clockwise: a split and a merge, 4-way and T intersections with
/// stoplines (straight on and to the left), a stretch of three lanes per direction, bends of 12 m and 42 m
/// radius, an S-bend, and a hill.
Road town(double speed_mps);

}  // namespace laneloom::simulation
