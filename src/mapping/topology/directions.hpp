#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/reasons.hpp"
#include "laneloom/types.hpp"
#include "mapping/lanes/lane_tracks.hpp"
#include "mapping/topology/road_graph.hpp"
#include "mapping/topology/traffic.hpp"

namespace laneloom::topology {

/// Adds evidence of the traffic's direction to the remembered lanes: the vehicle drives in a lane. Evidence
/// adds up over frames, to a limit. It fades while the vehicle drives beside the lane. Remembers which lanes
/// the vehicle drove in.
void observe_drive(const std::vector<Lane>& lanes, const Eigen::Isometry3d& T_map_body,
                   lanes::LaneTracks& tracks);

/// Adds the evidence of stoplines likewise: one lies across one end of a lane.
void observe_stoplines(const std::vector<Lane>& lanes, const std::vector<Marking>& markings,
                       const StoplineConfig& config, lanes::LaneTracks& tracks);

/// Sets the driving direction of every lane for which it can be told, and turns the lane to run with the
/// traffic. Ours, beyond the paper.
///
/// Lanes that continue one another run the same way. Where two lanes side by side run against each other,
/// each has the other on the side that is not driven on. The boundary between two lanes speaks for opposite
/// directions or against them (side_by_side.hpp). The outermost lane at an edge, or at a solid line, runs as
/// the driving side says. Each trail that was driven in a lane
/// for 5 m speaks for its direction, the first one most. These and the remembered evidence are weighed
/// against one another by max-product belief propagation. A direction that was sure stays known until it is
/// contradicted; `tracks` remember it.
///
/// `traffic` is that of `road`.
///
/// Linkages between lanes that are turned are turned too. At last the turn of every linkage is set.
///
/// `reasons` has those of the lanes, and may be null.
void find_directions(const DirectionConfig& config, const RoadTraffic& traffic, lanes::LaneTracks& tracks,
                     RoadGraph& road, FrameReasons* reasons = nullptr);

}  // namespace laneloom::topology
