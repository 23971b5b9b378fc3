#pragma once

#include "AutowareMaplessPlanningMsgs.hpp"
#include "laneloom/messages.hpp"

namespace laneloom::ros2 {

/// The map's lanes as Autoware's mapless nodes read them, in the vehicle's frame at the map's stamp: the
/// vehicle is at the origin. Segments are numbered from 0 in each message. A segment's first line is its left
/// one. A segment has two neighbours, left and right; a neighbour that does not exist, or runs the other way,
/// is -1. A segment that nothing continues has the one successor -1. A linkage across a gap is a segment of
/// its own. If there are more segments than 16 bits can number, the last ones are left out.
autoware_mapless_planning_msgs::msg::dds_::RoadSegments_ to_road_segments(const PublishedMap& map);

}  // namespace laneloom::ros2
