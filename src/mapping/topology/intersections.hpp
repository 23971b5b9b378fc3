#pragma once

#include "laneloom/config.hpp"
#include "laneloom/sd_map.hpp"
#include "mapping/topology/road_graph.hpp"

namespace laneloom {

/// Across an intersection, where no marking leads. Ours, beyond the paper. A lane that ends goes straight on
/// into the lane that begins ahead of it in line, and turns into the nearest lane that begins to its left or
/// right: from the outermost lane of its direction into the outermost one, on an arc that is wide enough,
/// where the driving directions of both are known. No way leads over an edge, and for each kind of turn, no
/// lane is left or entered twice. A lane of unknown direction takes that of the one that it leads straight on
/// from or into. Each linkage has a path, and a confidence that falls with the misfit.
///
/// Where both lanes lie on streets of `sd_map` (paper, Sec. III-D-4), that decides: it confirms or forbids
/// the way, or supplies one between lanes that lie less regularly.
void link_across_intersections(const SdMap& sd_map, const LinkageConfig& config, RoadGraph& road);

}  // namespace laneloom
