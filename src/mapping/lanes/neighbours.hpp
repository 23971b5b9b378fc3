#pragma once

#include <vector>

#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"

namespace laneloom {

/// Names for every lane all lanes on the other side of its boundaries, each with the stretch along which the
/// two lie side by side. Each of two neighbours names the other. `boundaries` are those of the lanes, by
/// ascending id.
void find_neighbours(const std::vector<LaneBoundary>& boundaries, std::vector<Lane>& lanes);

}  // namespace laneloom
