#pragma once

#include "laneloom/config.hpp"
#include "laneloom/sd_map.hpp"
#include "mapping/topology/road_graph.hpp"

namespace laneloom::topology {

/// Links lanes across intersections, where no marking leads. Ours, beyond the paper. A lane that ends goes
/// straight on into the lane that begins ahead of it in line. It turns into the nearest lane that begins to
/// its left or right, from the outermost lane of its direction into the outermost one, on an arc that is wide
/// enough, if the driving directions of both are known. No path leads over an edge. For each kind of turn, no
/// lane is left or entered twice. A lane of unknown direction takes the direction of a lane that it is linked
/// to straight on. Each linkage has a path, and a probability that falls with the misfit.
///
/// If both lanes lie on streets of `sd_map` (paper, Sec. III-D-4), the SD map decides: it confirms or forbids
/// the linkage, or supplies one between lanes that lie less regularly.
void link_across_intersections(const SdMap& sd_map, const LinkageConfig& config, RoadGraph& road);

}  // namespace laneloom::topology
