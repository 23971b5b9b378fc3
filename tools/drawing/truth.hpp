#pragma once

#include <limits>

#include "drawing/drawing.hpp"
#include "laneloom/types.hpp"
#include "simulation/road.hpp"

namespace laneloom::drawing {

/// Adds the truth's markings as thin lines, which lie beneath a map.
void add_truth(const simulation::Road& truth, Drawing& drawing);

/// The truth as a map to draw, with the lanes' driving directions and successors, seen from a vehicle at
/// `T_map_body`. Lines and lanes that are nowhere within `reach_m` of the vehicle are left out.
LocalMap map_of(const simulation::Road& truth, const Eigen::Isometry3d& T_map_body,
                double reach_m = std::numeric_limits<double>::infinity());

}  // namespace laneloom::drawing
