#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/lanes/lane_memory.hpp"
#include "mapping/topology/road_graph.hpp"

namespace laneloom {

/// Remembers what tells the traffic's direction of a lane, in the remembered lanes of the same ids: the
/// vehicle drives in it, or a stopline lies across one of its ends. Evidence adds up over frames, to a limit;
/// it fades while the vehicle drives beside the lane.
void observe_directions(const std::vector<Lane>& lanes, const Eigen::Isometry3d& T_map_body,
                        const std::vector<Marking>& markings, const StoplineConfig& config,
                        LaneMemory& memory);

/// Gives every lane its driving direction where that can be told, and turns it to run with the traffic. Ours,
/// beyond the paper.
///
/// Lanes that continue one another run the same way. Beside each other, the traffic from the side that is not
/// driven on does not come from the far side of the lane; what lies between two lanes speaks for opposite
/// directions or against them (side_by_side.hpp); the outermost lane at an edge, or at a solid line, runs as
/// the driving side says. These and the remembered evidence are weighed against one another by max-product
/// belief propagation. What was sure stays known until it is contradicted; `memory` remembers it.
///
/// Linkages between lanes that are turned are turned too. Then every linkage is told which way it turns.
void find_directions(const DirectionConfig& config, LaneMemory& memory, RoadGraph& road);

}  // namespace laneloom
