#pragma once

#include "drawing/drawing.hpp"
#include "laneloom/types.hpp"
#include "simulation/road.hpp"

namespace laneloom::drawing {

/// Adds the truth's markings as thin lines, which lie beneath a map.
void add_truth(const simulation::Road& truth, Drawing& drawing);

/// The truth as a map to draw, with the lanes' driving directions and successors.
LocalMap map_of(const simulation::Road& truth);

}  // namespace laneloom::drawing
