#pragma once

#include <vector>

#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"

namespace laneloom {

/// Cuts boundaries that pass over or under themselves, half the way between, so that beside each place there
/// is one stretch of a boundary. No local map has such a one. `boundaries` stay in the order of their ids;
/// `next_id` is above all of them.
void cut_self_crossings(std::vector<LaneBoundary>& boundaries, ElementId& next_id);

}  // namespace laneloom
