#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/lanes/lane_layout.hpp"

namespace laneloom::lanes {

/// Finds the forks of a road, and cuts the stems there. A branch begins where its two borders meet. Its stem
/// lies beyond the border that gives way to it: that turns aside from the course before the place where they
/// meet. If both give way alike, there is no fork, because the branch may belong to either direction of
/// traffic. Ours.
std::vector<Fork> cut_at_forks(const boundaries::Boundaries& boundaries, const LaneConfig& config,
                               std::vector<Lane>& lanes);

}  // namespace laneloom::lanes
