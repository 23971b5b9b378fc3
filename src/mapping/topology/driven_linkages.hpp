#pragma once

#include <utility>
#include <vector>

#include "mapping/topology/road_graph.hpp"
#include "mapping/topology/traffic.hpp"
#include "mapping/trails/trails.hpp"

/// Linkages between lanes that were driven from the one to the other. Ours, beyond the paper.
namespace laneloom::topology {

/// From one lane into another.
using LaneStep = std::pair<ElementId, ElementId>;

/// Who drove from lane to lane.
enum class Driver { ego, other };

/// Whether a vehicle that left `from` and came into `to` shows that the one continues the other: it did not
/// change lanes, and `to` begins no further back than `from` ends.
bool is_step(const Lane& from, const Lane& to);

/// Links the lanes of each step. A linkage that is there stays; one across an intersection that was inferred
/// is confirmed.
void link_driven(const std::vector<LaneStep>& steps, Driver driver, RoadGraph& road);

/// Links lanes where others left the one at its end and came into the other one at its start. `driven` are
/// the stretches of the trails in the lanes of the road.
void link_traffic(const std::vector<trails::Trail>& trails, const std::vector<DrivenStretch>& driven,
                  RoadGraph& road);

}  // namespace laneloom::topology
