#pragma once

#include "laneloom/types.hpp"
#include "simulation/road.hpp"

namespace laneloom {

/// The truth as a map to draw, with the lanes' driving directions and successors.
LocalMap map_of(const Road& truth);

}  // namespace laneloom
