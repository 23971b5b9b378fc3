#pragma once

#include "mapping/lanes/lane_layout.hpp"

namespace laneloom::lanes {

/// Sets the neighbours of every lane: the lanes on the other side of its boundaries, each with the stretch
/// along which the two lie side by side. Each of two neighbours names the other.
void find_neighbours(LaneLayout& layout);

}  // namespace laneloom::lanes
