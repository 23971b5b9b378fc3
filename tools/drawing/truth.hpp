#pragma once

#include "drawing/drawing.hpp"
#include "laneloom/types.hpp"
#include "simulation/road.hpp"

namespace laneloom {

/// Adds the truth's markings as thin lines, which lie beneath a map.
void add_truth(const Road& truth, Drawing& drawing);

/// The truth as a map to draw, with the lanes' driving directions and successors.
LocalMap map_of(const Road& truth);

}  // namespace laneloom
