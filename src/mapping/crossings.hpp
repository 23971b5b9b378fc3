#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// Across an intersection, where no marking leads: a lane that ends goes straight on into the lane that
/// begins ahead of it in line, if each is the other's best fit and neither is linked otherwise on that side.
/// Ours, beyond the paper. Each linkage has a path, and a confidence that falls with offset and angle.
void link_across_intersections(const std::vector<Lane>& lanes, const LinkageConfig& config,
                               std::vector<Linkage>& linkages);

}  // namespace laneloom
